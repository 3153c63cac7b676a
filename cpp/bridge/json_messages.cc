#include "bridge/json_messages.h"

#include <cmath>

#include "bus/alarm_json.h"

namespace skein::bridge {
namespace {

Json Vehicle(const vehicle_info_t& info) {
  return {{"id", info.id},
          {"callsign", info.callsign},
          {"model", info.model},
          {"k_speed_per_s", info.k_speed_per_s},
          {"k_course_per_s", info.k_course_per_s},
          {"k_climb_per_s", info.k_climb_per_s},
          {"min_speed_m_s", info.min_speed_m_s},
          {"max_speed_m_s", info.max_speed_m_s},
          {"max_acceleration_m_s2", info.max_acceleration_m_s2},
          {"max_course_rate_rad_s", info.max_course_rate_rad_s},
          {"max_climb_rad", info.max_climb_rad},
          {"max_climb_rate_rad_s", info.max_climb_rate_rad_s},
          {"has_payload", info.has_payload != 0}};
}

Json Slot(const slot_t& slot) {
  return {{"vehicle_id", slot.vehicle_id},
          {"forward_m", slot.forward_m},
          {"left_m", slot.left_m},
          {"up_m", slot.up_m}};
}

/// Statuses come several times a second: a centimetre, and a hundred-thousandth of a radian, are enough.
double Cm(double metres) { return std::round(metres * 100) / 100; }
double Fine(double radians) { return std::round(radians * 1e5) / 1e5; }

Json SlotStatus(const slot_status_t& slot) {
  return {{"vehicle_id", slot.vehicle_id},
          {"slot_east_m", Cm(slot.slot_east_m)},
          {"slot_north_m", Cm(slot.slot_north_m)},
          {"slot_up_m", Cm(slot.slot_up_m)},
          {"forward_error_m", Cm(slot.forward_error_m)},
          {"left_error_m", Cm(slot.left_error_m)},
          {"up_error_m", Cm(slot.up_error_m)},
          {"flown", slot.flown != 0}};
}

Json Point(const waypoint_t& point) {
  return {{"east_m", point.east_m},
          {"north_m", point.north_m},
          {"up_m", point.up_m},
          {"speed_m_s", point.speed_m_s},
          {"turn_radius_m", point.turn_radius_m}};
}

}  // namespace

Json ToJson(const fleet_roster_t& roster) {
  return {{"type", "roster"},
          {"utime", roster.utime},
          {"scenario", roster.scenario},
          {"start_utime", roster.start_utime},
          {"origin",
           {{"latitude_deg", roster.origin_latitude_deg},
            {"longitude_deg", roster.origin_longitude_deg},
            {"altitude_m", roster.origin_altitude_m}}},
          {"vehicles", Each(roster.vehicles, Vehicle)}};
}

Json ToJson(const formation_t& formation) {
  return {{"type", "formation"},
          {"utime", formation.utime},
          {"formation_id", formation.formation_id},
          {"name", formation.name},
          {"control", formation.control},
          {"shape", formation.shape},
          {"spacing_m", formation.spacing_m},
          {"lead_m", formation.lead_m},
          {"radius_m", formation.radius_m},
          {"height_m", formation.height_m},
          {"d_mod_m", formation.d_mod_m},
          {"advisory_tau_s", formation.advisory_tau_s},
          {"caution_tau_s", formation.caution_tau_s},
          {"hold", formation.hold != 0},
          {"parameters", Each(formation.parameters,
                              [](const parameter_t& parameter) {
                                return Json{{"name", parameter.name}, {"value", parameter.value}};
                              })},
          {"slots", Each(formation.slots, Slot)}};
}

Json ToJson(const formation_status_t& status) {
  return {{"type", "status"},
          {"utime", status.utime},
          {"formation_id", status.formation_id},
          {"tick", status.tick},
          {"mode", status.mode},
          {"mode_utime", status.mode_utime},
          {"mode_end_utime", status.mode_end_utime},
          {"mode_text", status.mode_text},
          {"leader_east_m", Cm(status.leader_east_m)},
          {"leader_north_m", Cm(status.leader_north_m)},
          {"leader_up_m", Cm(status.leader_up_m)},
          {"leader_speed_m_s", Cm(status.leader_speed_m_s)},
          {"leader_course_rad", Fine(status.leader_course_rad)},
          {"leader_climb_rad", Fine(status.leader_climb_rad)},
          {"leader_arc_m", Cm(status.leader_arc_m)},
          {"path_revision", status.path_revision},
          {"avoidance_up_m", Cm(status.avoidance_up_m)},
          {"avoidance_rate_m_s", Cm(status.avoidance_rate_m_s)},
          {"avoidance_target_m", Cm(status.avoidance_target_m)},
          {"slots", Each(status.slots, SlotStatus)}};
}

Json ToJson(const event_t& event) {
  return {{"type", "event"},
          {"utime", event.utime},
          {"event_node", event.event_node},
          {"event_sequence", event.event_sequence},
          {"severity", event.severity},
          {"code", event.code},
          {"vehicle_id", event.vehicle_id},
          {"formation_id", event.formation_id},
          {"text", event.text}};
}

Json ToJson(const heartbeat_t& heartbeat) {
  return {{"type", "heartbeat"},
          {"utime", heartbeat.utime},
          {"heartbeat_node", heartbeat.heartbeat_node},
          {"version", heartbeat.version},
          {"session_id", heartbeat.session_id},
          {"start_utime", heartbeat.start_utime},
          {"messages_in", heartbeat.messages_in},
          {"messages_out", heartbeat.messages_out},
          {"gaps", heartbeat.gaps},
          {"undecodable", heartbeat.undecodable},
          {"handler_exceptions", heartbeat.handler_exceptions},
          {"worst_handler_us", heartbeat.worst_handler_us},
          {"receive_buffer_bytes", heartbeat.receive_buffer_bytes}};
}

Json ToJson(const alarm_list_t& list) {
  return {{"type", "alarms"},
          {"utime", list.utime},
          {"session_id", list.session_id},
          {"newest_id", list.newest_id},
          {"num_warnings", list.num_warnings},
          {"num_cautions", list.num_cautions},
          {"num_advisories", list.num_advisories},
          {"num_unacknowledged_warnings", list.num_unacknowledged_warnings},
          {"num_unacknowledged_cautions", list.num_unacknowledged_cautions},
          {"num_unacknowledged_advisories", list.num_unacknowledged_advisories},
          {"num_not_listed", list.num_not_listed},
          {"alarms", Each(list.alarms, [](const alarm_t& alarm) { return bus::ToJson(alarm); })}};
}

Json ToJson(const recording_status_t& status) {
  return {{"type", "recording"},
          {"utime", status.utime},
          {"session_id", status.session_id},
          {"state", status.state},
          {"folder", status.folder},
          {"recording", status.recording},
          {"part", status.part},
          {"started_utime", status.started_utime},
          {"parts", status.parts},
          {"bytes", status.bytes},
          {"free_bytes", status.free_bytes},
          {"reason", status.reason}};
}

Json ToJson(const path_t& path) {
  return {{"type", "path"},
          {"utime", path.utime},
          {"formation_id", path.formation_id},
          {"path_revision", path.path_revision},
          {"closed", path.loop_start_m != -1},
          {"waypoints", Each(path.waypoints, Point)}};
}

std::string Dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace skein::bridge

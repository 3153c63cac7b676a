#include "bus/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "bus/text.h"

namespace skein::bus {
namespace {

// Far beyond anything that flies, and small enough that no sum or square of them overflows.
constexpr double kLargest = 1e9;
constexpr std::int64_t kLargestTime = std::int64_t{1} << 62;
constexpr int kMostChunks = 100'000;
constexpr std::size_t kLongestNode = 100;

bool Within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN
bool Number(double value) { return Within(value, -kLargest, kLargest); }
bool Positive(double value) { return value > 0 && value <= kLargest; }
bool NotNegative(double value) { return Within(value, 0, kLargest); }
bool NotNegativeOrNone(double value) { return NotNegative(value) || value == -1; }
bool Angle(double value) { return Within(value, -std::numbers::pi, std::numbers::pi); }

bool Numbers(std::same_as<double> auto... values) { return (Number(values) && ...); }

bool Time(std::int64_t utime) { return utime >= 0 && utime <= kLargestTime; }
bool Sequence(std::int64_t number) { return number >= 0 && number <= kLargestTime; }
bool Id(std::int32_t id) { return id >= 1; }
bool IdOrNone(std::int32_t id) { return id >= 0; }
bool Chunk(std::int32_t chunk, std::int32_t count) {
  return chunk >= 0 && chunk < count && count <= kMostChunks;
}
bool OneOf(int value, int last) { return value >= 0 && value <= last; }

/// Length of the UTF-8 sequence at the start of `text`, 0 when there is none (overlong ones and surrogates
/// are none).
std::size_t CharacterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool second = follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

bool Text(std::string_view text) {
  if (text.size() > kLongestText) return false;
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    if ((first < 0x20 && first != '\n' && first != '\t') || first == 0x7F) return false;
    const std::size_t length = CharacterLength(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}
bool Name(std::string_view text) { return !text.empty() && Text(text); }

template <typename Items, typename Check>
bool Every(const Items& items, Check check) {
  return std::all_of(items.begin(), items.end(), check);
}

bool ValidItem(const alarm_t& alarm) {
  return alarm.id >= 1 && Sequence(alarm.id) && Name(alarm.condition) &&
         Within(alarm.severity, event_t::ADVISORY, event_t::WARNING) && OneOf(alarm.state, alarm_t::OVER) &&
         IdOrNone(alarm.vehicle_id) && IdOrNone(alarm.other_vehicle_id) && IdOrNone(alarm.formation_id) &&
         Text(alarm.text) && Time(alarm.raised_utime) && Time(alarm.cleared_utime) &&
         Time(alarm.acknowledged_utime) && Text(alarm.acknowledged_by) && Time(alarm.shelved_until_utime) &&
         Text(alarm.shelved_by);
}

bool ValidItem(const vehicle_info_t& info) {
  return Id(info.id) && Name(info.callsign) && Name(info.model) && Positive(info.k_speed_per_s) &&
         Positive(info.k_course_per_s) && Positive(info.k_climb_per_s) && NotNegative(info.min_speed_m_s) &&
         Number(info.max_speed_m_s) && info.max_speed_m_s > info.min_speed_m_s &&
         Positive(info.max_acceleration_m_s2) && Positive(info.max_course_rate_rad_s) &&
         Within(info.max_climb_rad, 0, std::numbers::pi / 2) && Positive(info.max_climb_rate_rad_s);
}

bool ValidItem(const vehicle_state_t& state) {
  return Time(state.utime) && Id(state.id) &&
         Numbers(state.east_m, state.north_m, state.up_m, state.speed_m_s, state.course_rad,
                 state.climb_rad) &&
         Sequence(state.command_session_id) && Sequence(state.command_sequence);
}

bool ValidItem(const vehicle_command_t& command) {
  return Id(command.id) && Sequence(command.sequence) &&
         Numbers(command.speed_input_m_s, command.course_input_rad, command.climb_input_rad,
                 command.setpoint_speed_m_s, command.setpoint_climb_rad, command.setpoint_acceleration_m_s2,
                 command.setpoint_course_rate_rad_s, command.setpoint_climb_rate_rad_s) &&
         Angle(command.setpoint_course_rad);
}

bool ValidItem(const slot_status_t& slot) {
  return Id(slot.vehicle_id) && Numbers(slot.slot_east_m, slot.slot_north_m, slot.slot_up_m,
                                        slot.forward_error_m, slot.left_error_m, slot.up_error_m);
}

bool ValidItem(const vehicle_link_t& link) {
  return Id(link.id) && OneOf(link.downlink, link_status_t::LINK_UNKNOWN) &&
         OneOf(link.uplink, link_status_t::LINK_UNKNOWN) && NotNegativeOrNone(link.downlink_age_s) &&
         NotNegativeOrNone(link.uplink_age_s) &&
         Numbers(link.estimated_east_m, link.estimated_north_m, link.estimated_up_m) &&
         NotNegative(link.horizontal_uncertainty_m) && NotNegative(link.vertical_uncertainty_m);
}

bool ValidItem(const vehicle_proximity_t& vehicle) {
  return Id(vehicle.id) && OneOf(vehicle.level, 3) && IdOrNone(vehicle.level_with_id) &&
         IdOrNone(vehicle.nearest_id) && NotNegativeOrNone(vehicle.nearest_horizontal_m) &&
         NotNegativeOrNone(vehicle.nearest_vertical_m) && IdOrNone(vehicle.tau_id) &&
         NotNegativeOrNone(vehicle.tau_s);
}

bool ValidItem(const path_piece_t& piece) {
  return Positive(piece.length_m) && Numbers(piece.start_east_m, piece.start_north_m, piece.start_course_rad,
                                             piece.start_curvature_per_m, piece.end_curvature_per_m);
}

bool ValidItem(const path_profile_t& knot) {
  return Numbers(knot.arc_m, knot.altitude_m, knot.up_slope, knot.up_slope_rate_per_m, knot.speed_slope_per_s,
                 knot.speed_slope_rate_per_m_s) &&
         Positive(knot.planned_speed_m_s);
}

bool ValidItem(const waypoint_t& waypoint) {
  return Numbers(waypoint.east_m, waypoint.north_m, waypoint.up_m, waypoint.speed_m_s,
                 waypoint.turn_radius_m);
}

bool ValidItem(const slot_t& slot) { return Numbers(slot.forward_m, slot.left_m, slot.up_m); }
bool ValidItem(const parameter_t& parameter) { return Text(parameter.name) && Number(parameter.value); }

template <typename Items>
bool ValidItems(const Items& items) {
  return Every(items, [](const auto& item) { return ValidItem(item); });
}

/// Whether no two items have the same id. Senders mostly have them in order.
template <typename Items, typename Member>
bool Unique(const Items& items, Member id) {
  const auto not_rising = [id](const auto& a, const auto& b) { return a.*id >= b.*id; };
  if (std::ranges::adjacent_find(items, not_rising) == items.end()) return true;
  std::vector<std::int32_t> ids;
  ids.reserve(items.size());
  for (const auto& item : items) ids.push_back(item.*id);
  std::ranges::sort(ids);
  return std::ranges::adjacent_find(ids) == ids.end();
}

template <typename Command>
bool ValidRequest(const Command& command) {
  return Time(command.utime) && Sequence(command.session_id) && Sequence(command.request_id) &&
         Sequence(command.to_session_id);
}

/// So much of a formation that nothing breaks.
bool Harmless(const formation_t& formation) {
  return Time(formation.utime) && Text(formation.name) && Text(formation.control) && Text(formation.shape) &&
         Numbers(formation.spacing_m, formation.lead_m, formation.radius_m, formation.height_m,
                 formation.d_mod_m, formation.advisory_tau_s, formation.caution_tau_s) &&
         ValidItems(formation.parameters) && ValidItems(formation.slots);
}

bool ValidShape(std::string_view shape) {
  constexpr std::array<std::string_view, 8> kShapes = {
      "triangle", "column", "line_abreast", "echelon_left", "echelon_right", "diamond", "vee", "custom"};
  return std::find(kShapes.begin(), kShapes.end(), shape) != kShapes.end();
}

}  // namespace

bool Valid(const ack_t& ack) {
  return Time(ack.utime) && Sequence(ack.command_session_id) && Sequence(ack.command_request_id) &&
         Name(ack.node) && Sequence(ack.session_id) && Name(ack.command_channel) && Text(ack.reason);
}

bool Valid(const alarm_command_t& command) {
  return ValidRequest(command) && OneOf(command.action, alarm_command_t::ACTION_UNSHELVE) &&
         Text(command.operator_name) && Sequence(command.alarm_session_id) &&
         Sequence(command.all_up_to_id) && Number(command.duration_s);
}

bool Valid(const alarm_list_t& list) {
  const auto counts = {list.num_warnings,
                       list.num_cautions,
                       list.num_advisories,
                       list.num_unacknowledged_warnings,
                       list.num_unacknowledged_cautions,
                       list.num_unacknowledged_advisories,
                       list.num_not_listed};
  return Time(list.utime) && Sequence(list.session_id) && Sequence(list.sequence) &&
         Sequence(list.newest_id) && Every(counts, [](int count) { return count >= 0; }) &&
         Chunk(list.chunk, list.chunk_count) && ValidItems(list.alarms);
}

bool Valid(const event_t& event) {
  return Time(event.utime) && Name(event.event_node) && Sequence(event.event_sequence) &&
         OneOf(event.severity, event_t::WARNING) && Name(event.code) && IdOrNone(event.vehicle_id) &&
         IdOrNone(event.formation_id) && Text(event.text);
}

bool Valid(const fleet_command_t& command) {
  return ValidRequest(command) && Sequence(command.state_tick) && Chunk(command.chunk, command.chunk_count) &&
         ValidItems(command.commands) && Unique(command.commands, &vehicle_command_t::id);
}

bool Valid(const fleet_roster_t& roster) {
  return Time(roster.utime) && Sequence(roster.session_id) && Text(roster.scenario) &&
         Time(roster.start_utime) && Within(roster.origin_latitude_deg, -90, 90) &&
         Within(roster.origin_longitude_deg, -180, 180) && Number(roster.origin_altitude_m) &&
         Sequence(roster.revision) && Chunk(roster.chunk, roster.chunk_count) &&
         ValidItems(roster.vehicles) && Unique(roster.vehicles, &vehicle_info_t::id);
}

bool Valid(const fleet_state_t& state) {
  return Time(state.utime) && Sequence(state.session_id) && Sequence(state.tick) &&
         Chunk(state.chunk, state.chunk_count) && ValidItems(state.vehicles) &&
         Unique(state.vehicles, &vehicle_state_t::id);
}

bool Valid(const formation_command_t& command) {
  return ValidRequest(command) && OneOf(command.action, formation_command_t::ACTION_REMOVE) &&
         Harmless(command.formation);
}

bool Valid(const formation_status_t& status) {
  return Time(status.utime) && Id(status.formation_id) && Sequence(status.tick) &&
         OneOf(status.mode, formation_status_t::MODE_WAITING) && Time(status.mode_utime) &&
         Time(status.mode_end_utime) && Text(status.mode_text) &&
         Numbers(status.leader_east_m, status.leader_north_m, status.leader_up_m, status.leader_speed_m_s,
                 status.leader_course_rad, status.leader_climb_rad, status.leader_arc_m,
                 status.avoidance_up_m, status.avoidance_rate_m_s, status.avoidance_target_m) &&
         Sequence(status.path_revision) && Chunk(status.chunk, status.chunk_count) &&
         ValidItems(status.slots) && Unique(status.slots, &slot_status_t::vehicle_id);
}

bool Valid(const formation_t& formation) {
  return Harmless(formation) && Id(formation.formation_id) &&
         (formation.control == "skein" || formation.control == "paper") && ValidShape(formation.shape) &&
         NotNegative(formation.spacing_m) && NotNegative(formation.lead_m) && Positive(formation.radius_m) &&
         Positive(formation.height_m) && formation.d_mod_m >= formation.radius_m &&
         Positive(formation.caution_tau_s) && formation.advisory_tau_s > formation.caution_tau_s &&
         Every(formation.slots, [](const slot_t& slot) { return Id(slot.vehicle_id); }) &&
         Unique(formation.slots, &slot_t::vehicle_id);
}

bool Valid(const heartbeat_t& heartbeat) {
  return Time(heartbeat.utime) && Name(heartbeat.heartbeat_node) &&
         heartbeat.heartbeat_node.size() <= kLongestNode && Text(heartbeat.version) &&
         Sequence(heartbeat.session_id) && Time(heartbeat.start_utime) && Sequence(heartbeat.messages_in) &&
         Sequence(heartbeat.messages_out) && Sequence(heartbeat.gaps) && Sequence(heartbeat.undecodable) &&
         Sequence(heartbeat.handler_exceptions) && Sequence(heartbeat.worst_handler_us) &&
         Sequence(heartbeat.receive_buffer_bytes);
}

bool Valid(const link_command_t& command) {
  return ValidRequest(command) && OneOf(command.mode, link_command_t::MODE_RESTORED) &&
         Numbers(command.delay_s, command.jitter_s, command.loss, command.duration_s) &&
         Time(command.start_utime);
}

bool Valid(const link_status_t& status) {
  return Time(status.utime) && Sequence(status.sequence) && Chunk(status.chunk, status.chunk_count) &&
         ValidItems(status.links) && Unique(status.links, &vehicle_link_t::id);
}

bool Valid(const path_command_t& command) { return ValidRequest(command) && ValidItems(command.waypoints); }

bool Valid(const path_t& path) {
  const auto not_rising = [](const path_profile_t& a, const path_profile_t& b) { return a.arc_m >= b.arc_m; };
  return Time(path.utime) && Id(path.formation_id) && Sequence(path.path_revision) &&
         Number(path.start_arc_m) &&
         (path.loop_start_m == -1 || (Number(path.loop_start_m) && path.loop_start_m >= path.start_arc_m)) &&
         ValidItems(path.pieces) && ValidItems(path.profile) && ValidItems(path.waypoints) &&
         std::adjacent_find(path.profile.begin(), path.profile.end(), not_rising) == path.profile.end();
}

bool Valid(const payload_command_t& command) { return ValidRequest(command); }

bool Valid(const proximity_t& proximity) {
  return Time(proximity.utime) && Sequence(proximity.sweep) &&
         Chunk(proximity.chunk, proximity.chunk_count) && ValidItems(proximity.vehicles);
}

bool Valid(const recording_command_t& command) {
  return ValidRequest(command) && Sequence(command.to_session_id) &&
         OneOf(command.action, recording_command_t::ACTION_MARKER) && Text(command.operator_name) &&
         Text(command.text);
}

bool Valid(const recording_status_t& status) {
  return Time(status.utime) && Sequence(status.session_id) &&
         OneOf(status.state, recording_status_t::INTERRUPTED) && Name(status.folder) &&
         Text(status.recording) && Text(status.part) && Time(status.started_utime) && status.parts >= 0 &&
         Sequence(status.bytes) && (Sequence(status.free_bytes) || status.free_bytes == -1) &&
         Text(status.reason);
}

bool Valid(const simulation_command_t& command) {
  return ValidRequest(command) && OneOf(command.action, simulation_command_t::ACTION_LOAD) &&
         Text(command.scenario) && Sequence(command.seed);
}

}  // namespace skein::bus

#include "unit/bus/hostile/samples.h"

namespace skein::bus::testing {
namespace {

/// As many items as it takes, numbered from 1 by `name_id`.
template <typename Item, typename Fill>
std::vector<Item> Two(Fill fill) {
  std::vector<Item> items(2);
  for (int i = 0; i < 2; ++i) fill(items[static_cast<std::size_t>(i)], i + 1);
  return items;
}

std::vector<waypoint_t> Waypoints() {
  return Two<waypoint_t>([](waypoint_t& waypoint, int number) {
    waypoint.east_m = 1000.0 * number;
    waypoint.speed_m_s = 50;
  });
}

template <typename Message>
Message Chunk() {
  Message message;
  message.utime = 1'700'000'000'000'000;
  message.chunk_count = 1;
  return message;
}

template <typename Command>
Command Request() {
  Command command;
  command.utime = 1'700'000'000'000'000;
  command.session_id = 1'699'000'000'000'000;
  command.request_id = 1;
  command.to_session_id = 1'699'500'000'000'000;
  return command;
}

}  // namespace

template <>
ack_t Sample() {
  ack_t ack;
  ack.node = "fleet-simulator";
  ack.command_channel = "CMD_LINK";
  ack.reason = "there is no UAV 9";
  return ack;
}

template <>
alarm_command_t Sample() {
  auto command = Request<alarm_command_t>();
  command.operator_name = "skein";
  command.alarm_session_id = 1'698'000'000'000'000;
  command.alarm_ids = {7, 8};
  command.num_alarm_ids = 2;
  return command;
}

template <>
alarm_list_t Sample() {
  auto list = Chunk<alarm_list_t>();
  list.alarms = Two<alarm_t>([](alarm_t& item, int id) {
    item.id = id;
    item.condition = "link:3";
    item.severity = event_t::WARNING;
    item.text = "link of UAV3 lost";
  });
  list.num_alarms = 2;
  return list;
}

template <>
event_t Sample() {
  event_t event;
  event.event_node = "collision-monitor";
  event.code = "link_lost";
  event.text =
      "the link of UAV3 is lost: nothing heard for 4 s \xE2\x80\x94 Gr\xC3\xBC\xC3\x9F \xF0\x9F\x9B\xA9";
  return event;
}

template <>
fleet_command_t Sample() {
  auto command = Chunk<fleet_command_t>();
  command.commands = Two<vehicle_command_t>([](vehicle_command_t& item, int id) { item.id = id; });
  command.num_commands = 2;
  return command;
}

template <>
fleet_roster_t Sample() {
  auto roster = Chunk<fleet_roster_t>();
  roster.scenario = "triangle";
  roster.origin_latitude_deg = 40.08;
  roster.origin_longitude_deg = 116.58;
  roster.vehicles = Two<vehicle_info_t>([](vehicle_info_t& item, int id) {
    item.id = id;
    item.callsign = "UAV";
    item.model = "default";
    item.k_speed_per_s = 0.01;
    item.k_course_per_s = 0.1;
    item.k_climb_per_s = 0.1;
    item.min_speed_m_s = 30;
    item.max_speed_m_s = 90;
    item.max_acceleration_m_s2 = 2;
    item.max_course_rate_rad_s = 0.2;
    item.max_climb_rad = 0.35;
    item.max_climb_rate_rad_s = 0.2;
    item.has_payload = 1;
  });
  roster.num_vehicles = 2;
  return roster;
}

template <>
fleet_state_t Sample() {
  auto state = Chunk<fleet_state_t>();
  state.vehicles = Two<vehicle_state_t>([](vehicle_state_t& item, int id) { item.id = id; });
  state.num_vehicles = 2;
  return state;
}

template <>
formation_t Sample() {
  formation_t formation;
  formation.formation_id = 1;
  formation.name = "Alpha";
  formation.control = "skein";
  formation.shape = "triangle";
  formation.spacing_m = 500;
  formation.lead_m = 1000;
  formation.radius_m = 150;
  formation.height_m = 50;
  formation.d_mod_m = 150;
  formation.advisory_tau_s = 30;
  formation.caution_tau_s = 15;
  formation.parameters = Two<parameter_t>([](parameter_t& item, int) { item.name = "approach_speed_m_s"; });
  formation.num_parameters = 2;
  formation.slots = Two<slot_t>([](slot_t& item, int id) { item.vehicle_id = id; });
  formation.num_slots = 2;
  return formation;
}

template <>
formation_command_t Sample() {
  auto command = Request<formation_command_t>();
  command.formation = Sample<formation_t>();
  return command;
}

template <>
formation_status_t Sample() {
  auto status = Chunk<formation_status_t>();
  status.formation_id = 1;
  status.mode_text = "climbing 200 m: link of UAV3 lost";
  status.slots = Two<slot_status_t>([](slot_status_t& item, int id) { item.vehicle_id = id; });
  status.num_slots = 2;
  return status;
}

template <>
heartbeat_t Sample() {
  heartbeat_t heartbeat;
  heartbeat.heartbeat_node = "web-bridge";
  heartbeat.version = "0.1.0";
  return heartbeat;
}

template <>
link_command_t Sample() {
  auto command = Request<link_command_t>();
  command.vehicle_id = 3;
  return command;
}

template <>
link_status_t Sample() {
  auto status = Chunk<link_status_t>();
  status.links = Two<vehicle_link_t>([](vehicle_link_t& item, int id) {
    item.id = id;
    item.uplink_age_s = -1;
  });
  status.num_links = 2;
  return status;
}

template <>
path_command_t Sample() {
  auto command = Request<path_command_t>();
  command.formation_id = 1;
  command.waypoints = Waypoints();
  command.num_waypoints = 2;
  return command;
}

template <>
path_t Sample() {
  path_t path;
  path.formation_id = 1;
  path.loop_start_m = -1;
  path.pieces = Two<path_piece_t>([](path_piece_t& item, int) { item.length_m = 1000; });
  path.num_pieces = 2;
  path.profile = Two<path_profile_t>([](path_profile_t& item, int number) {
    item.arc_m = number;
    item.planned_speed_m_s = 50;
  });
  path.num_profile = 2;
  path.waypoints = Waypoints();
  path.num_waypoints = 2;
  return path;
}

template <>
payload_command_t Sample() {
  auto command = Request<payload_command_t>();
  command.on = 1;
  command.vehicle_ids = {1, 2};
  command.num_vehicle_ids = 2;
  return command;
}

template <>
proximity_t Sample() {
  auto proximity = Chunk<proximity_t>();
  proximity.vehicles = Two<vehicle_proximity_t>([](vehicle_proximity_t& item, int id) {
    item.id = id;
    item.tau_s = -1;
  });
  proximity.num_vehicles = 2;
  return proximity;
}

template <>
recording_command_t Sample() {
  auto command = Request<recording_command_t>();
  command.to_session_id = 1'698'000'000'000'000;
  command.action = recording_command_t::ACTION_MARKER;
  command.operator_name = "skein";
  command.text = "UAV3 sways";
  return command;
}

template <>
recording_status_t Sample() {
  recording_status_t status;
  status.utime = 1'700'000'000'000'000;
  status.session_id = 1'699'000'000'000'000;
  status.state = recording_status_t::RECORDING;
  status.folder = "/home/operator/skein/logs";
  status.recording = "triangle-20261125-143000.lcm";
  status.part = "triangle-20261125-143000.lcm.01";
  status.parts = 2;
  status.bytes = 300'000'000;
  status.free_bytes = -1;
  return status;
}

template <>
simulation_command_t Sample() {
  auto command = Request<simulation_command_t>();
  command.action = simulation_command_t::ACTION_LOAD;
  command.scenario = "triangle";
  return command;
}

}  // namespace skein::bus::testing

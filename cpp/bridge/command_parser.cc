#include "bridge/command_parser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bus/channels.h"
#include "config/json_reader.h"
#include "core/formation.h"
#include "core/proximity.h"

namespace skein::bridge {
namespace {

using config::Object;
using config::Range;
using config::Value;

constexpr Range kId{1, std::numeric_limits<std::int32_t>::max()};
constexpr Range kPlace_m{-1e6, 1e6};
constexpr Range kAltitude_m{-1e3, 1e5};
constexpr Range kSeconds{0, 1e6};
constexpr Range kSpeed_m_s{1, 1e3};
constexpr std::size_t kMaxItems = 1000;

int Integer(const Object& object, const char* key, Range range) { return object.At(key).Integer(range); }

/// Ids of sessions and alarms. JSON has doubles: whole to 2^53.
std::int64_t LongInteger(const Value& value) {
  const double number = value.Number({1, 9007199254740992.0});
  if (std::floor(number) != number) value.Refuse("must be a whole number");
  return static_cast<std::int64_t>(number);
}

/// The index of a text among those that it may be.
std::int8_t Choice(const Value& value, const std::vector<std::string>& choices) {
  const std::string text = value.Text();
  const auto found = std::ranges::find(choices, text);
  if (found == choices.end()) value.Refuse(config::UnknownName("value", text, choices));
  return static_cast<std::int8_t>(found - choices.begin());
}

std::vector<Value> FewItems(const Value& value) {
  std::vector<Value> items = value.Items();
  if (items.size() > kMaxItems) value.Refuse("holds more than " + std::to_string(kMaxItems) + " items");
  return items;
}

slot_t ParseSlot(const Value& value) {
  const Object object(value, {"vehicle_id", "forward_m", "left_m", "up_m"});
  slot_t slot{};
  slot.vehicle_id = Integer(object, "vehicle_id", kId);
  slot.forward_m = object.Number("forward_m", kPlace_m);
  slot.left_m = object.Number("left_m", kPlace_m);
  slot.up_m = object.Number("up_m", kAltitude_m, 0);
  return slot;
}

parameter_t ParseParameter(const Value& value) {
  const Object object(value, {"name", "value"});
  parameter_t parameter{};
  parameter.name = object.At("name").Text();
  parameter.value = object.Number("value", {-1e9, 1e9});
  return parameter;
}

formation_t ParseFormation(const Value& value) {
  const Object object(
      value, {"type", "utime", "formation_id", "name", "control", "shape", "spacing_m", "lead_m", "radius_m",
              "height_m", "d_mod_m", "advisory_tau_s", "caution_tau_s", "hold", "parameters", "slots"});
  const ProximityLimits limits;
  formation_t formation{};
  formation.formation_id = Integer(object, "formation_id", kId);
  formation.name = object.Text("name", "");
  formation.control = object.Text("control", "skein");
  formation.shape = object.Text("shape", "custom");
  if (!ShapeFromName(formation.shape)) object.At("shape").Refuse("there is no shape " + formation.shape);
  formation.spacing_m = object.Number("spacing_m", {0, 1e5}, 0);
  formation.lead_m = object.Number("lead_m", {0, 1e5}, 1000);
  formation.radius_m = object.Number("radius_m", {1, 1e5}, limits.radius_m);
  formation.height_m = object.Number("height_m", {1, 1e5}, limits.height_m);
  formation.d_mod_m = object.Number("d_mod_m", {1, 1e5}, std::max(limits.d_mod_m, formation.radius_m));
  formation.advisory_tau_s = object.Number("advisory_tau_s", {1, 1e4}, limits.advisory_tau_s);
  formation.caution_tau_s = object.Number("caution_tau_s", {1, 1e4}, limits.caution_tau_s);
  formation.hold = object.Boolean("hold", false);
  if (const auto parameters = object.Find("parameters")) {
    for (const Value& item : FewItems(*parameters)) formation.parameters.push_back(ParseParameter(item));
  }
  if (const auto slots = object.Find("slots")) {
    for (const Value& item : FewItems(*slots)) formation.slots.push_back(ParseSlot(item));
  }
  formation.num_parameters = static_cast<std::int32_t>(formation.parameters.size());
  formation.num_slots = static_cast<std::int32_t>(formation.slots.size());
  return formation;
}

}  // namespace

link_command_t ParseLinkCommand(const nlohmann::json& body, bus::Utime now) {
  const Value value = Value::FromJson(body, bus::channel::kCmdLink);
  const Object object(value, {"vehicle_id", "uplink", "downlink", "mode", "delay_s", "jitter_s", "loss",
                              "start_in_s", "duration_s"});
  link_command_t command{};
  command.vehicle_id = Integer(object, "vehicle_id", kId);
  command.mode = Choice(object.At("mode"), {"up", "silent", "frozen", "restored"});
  command.uplink = object.Boolean("uplink", true);
  command.downlink = object.Boolean("downlink", true);
  if (!command.uplink && !command.downlink)
    value.Refuse("uplink and downlink are both false: nothing would change");
  command.delay_s = object.Number("delay_s", {0, 60}, 0);
  command.jitter_s = object.Number("jitter_s", {0, 60}, 0);
  command.loss = object.Number("loss", {0, 1}, 0);
  const double start_in_s = object.Number("start_in_s", kSeconds, 0);
  command.start_utime = start_in_s > 0 ? now + bus::ToUtime(start_in_s) : 0;
  command.duration_s = object.Number("duration_s", kSeconds, 0);
  return command;
}

payload_command_t ParsePayloadCommand(const nlohmann::json& body) {
  const Object object(Value::FromJson(body, bus::channel::kCmdPayload), {"vehicle_ids", "on"});
  payload_command_t command{};
  command.on = object.At("on").Boolean();
  const Value ids = object.At("vehicle_ids");
  for (const Value& item : FewItems(ids)) command.vehicle_ids.push_back(item.Integer(kId));
  if (command.vehicle_ids.empty()) ids.Refuse("names no UAV");
  command.num_vehicle_ids = static_cast<std::int32_t>(command.vehicle_ids.size());
  return command;
}

formation_command_t ParseFormationCommand(const nlohmann::json& body) {
  const Object object(Value::FromJson(body, bus::channel::kCmdFormation), {"action", "formation"});
  formation_command_t command{};
  command.action = Choice(object.At("action"), {"apply", "hold", "resume", "remove"});
  const Value formation = object.At("formation");
  command.formation = ParseFormation(formation);
  if (command.action == formation_command_t::ACTION_APPLY && command.formation.slots.empty()) {
    formation.Refuse("has no slots");
  }
  return command;
}

path_command_t ParsePathCommand(const nlohmann::json& body) {
  const Object object(Value::FromJson(body, bus::channel::kCmdPath), {"formation_id", "closed", "waypoints"});
  path_command_t command{};
  command.formation_id = Integer(object, "formation_id", kId);
  command.closed = object.Boolean("closed", false);
  for (const Value& item : FewItems(object.At("waypoints"))) {
    const Object point(item, {"east_m", "north_m", "up_m", "speed_m_s", "turn_radius_m"});
    waypoint_t waypoint{};
    waypoint.east_m = point.Number("east_m", kPlace_m);
    waypoint.north_m = point.Number("north_m", kPlace_m);
    waypoint.up_m = point.Number("up_m", kAltitude_m);
    waypoint.speed_m_s = point.Number("speed_m_s", kSpeed_m_s);
    waypoint.turn_radius_m = point.Number("turn_radius_m", {0, 1e5}, 0);
    command.waypoints.push_back(waypoint);
  }
  command.num_waypoints = static_cast<std::int32_t>(command.waypoints.size());
  return command;
}

simulation_command_t ParseSimulationCommand(const nlohmann::json& body) {
  const Object object(Value::FromJson(body, bus::channel::kCmdSimulation), {"action", "scenario", "seed"});
  simulation_command_t command{};
  command.action = Choice(object.At("action"), {"restart", "load"});
  if (command.action == simulation_command_t::ACTION_LOAD) {
    command.scenario = object.At("scenario").Text();
  } else if (const auto scenario = object.Find("scenario")) {
    scenario->Refuse("goes with load only");
  }
  if (const auto seed = object.Find("seed")) {
    command.seed = seed->Integer({1, std::numeric_limits<std::int32_t>::max()});
  }
  return command;
}

alarm_command_t ParseAlarmCommand(const nlohmann::json& body) {
  const Object object(
      Value::FromJson(body, bus::channel::kCmdAlarm),
      {"action", "alarm_session_id", "alarm_ids", "all_up_to_id", "duration_s", "operator_name"});
  alarm_command_t command{};
  command.action = Choice(object.At("action"), {"acknowledge", "shelve", "unshelve"});
  command.alarm_session_id = LongInteger(object.At("alarm_session_id"));
  if (const auto ids = object.Find("alarm_ids")) {
    for (const Value& item : FewItems(*ids)) command.alarm_ids.push_back(LongInteger(item));
  }
  if (const auto newest = object.Find("all_up_to_id")) command.all_up_to_id = LongInteger(*newest);
  if (command.alarm_ids.empty() && command.all_up_to_id == 0) object.value().Refuse("names no alarm");
  if (command.action == alarm_command_t::ACTION_SHELVE) {
    command.duration_s = object.Number("duration_s", kSeconds);
  }
  command.operator_name = object.Text("operator_name", "web");
  command.num_alarm_ids = static_cast<std::int32_t>(command.alarm_ids.size());
  return command;
}

recording_command_t ParseRecordingCommand(const nlohmann::json& body) {
  const Object object(Value::FromJson(body, bus::channel::kCmdRecording),
                      {"action", "text", "operator_name"});
  recording_command_t command{};
  command.action = Choice(object.At("action"), {"start", "stop", "marker"});
  if (command.action == recording_command_t::ACTION_MARKER) {
    command.text = object.At("text").Text();
  } else if (const auto text = object.Find("text")) {
    text->Refuse("goes with marker only");
  }
  command.operator_name = object.Text("operator_name", "web");
  return command;
}

}  // namespace skein::bridge

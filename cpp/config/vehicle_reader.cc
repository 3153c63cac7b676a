#include <algorithm>
#include <cmath>

#include "config/readers.h"
#include "core/frames.h"

namespace skein::config {
namespace {

AutopilotGains ReadAutopilotGains(const Value& value, const AutopilotGains& otherwise) {
  constexpr Range kPerSecond{1e-4, 10};
  const Object object(value, {"speed_per_s", "course_per_s", "climb_per_s"});
  return {.speed_per_s = object.Number("speed_per_s", kPerSecond, otherwise.speed_per_s),
          .course_per_s = object.Number("course_per_s", kPerSecond, otherwise.course_per_s),
          .climb_per_s = object.Number("climb_per_s", kPerSecond, otherwise.climb_per_s)};
}

Envelope ReadEnvelope(const Value& value) {
  const Object object(value, {"min_speed_m_s", "max_speed_m_s", "max_acceleration_m_s2",
                              "max_course_rate_rad_s", "max_climb_rad", "max_climb_rate_rad_s"});
  Envelope envelope;
  envelope.min_speed_m_s = object.Number("min_speed_m_s", {0, 400}, envelope.min_speed_m_s);
  envelope.max_speed_m_s = object.Number("max_speed_m_s", kSpeedMS, envelope.max_speed_m_s);
  envelope.max_acceleration_m_s2 =
      object.Number("max_acceleration_m_s2", {0.01, 100}, envelope.max_acceleration_m_s2);
  envelope.max_course_rate_rad_s =
      object.Number("max_course_rate_rad_s", {0.001, 10}, envelope.max_course_rate_rad_s);
  envelope.max_climb_rad = object.Number("max_climb_rad", {0.001, 1.5}, envelope.max_climb_rad);
  envelope.max_climb_rate_rad_s =
      object.Number("max_climb_rate_rad_s", {0.001, 10}, envelope.max_climb_rate_rad_s);
  if (envelope.max_speed_m_s <= envelope.min_speed_m_s) {
    value.Refuse("max_speed_m_s must be greater than min_speed_m_s");
  }
  return envelope;
}

AutopilotGains Scaled(const AutopilotGains& gains, double factor) {
  return {gains.speed_per_s * factor, gains.course_per_s * factor, gains.climb_per_s * factor};
}

VehicleModel ReadInlineModel(const Value& value, std::string_view name) {
  const Object object(value, {"name", "gains", "envelope"});
  VehicleModel model;
  model.name = object.Text("name", name);
  if (const auto gains = object.Find("gains")) model.gains = ReadAutopilotGains(*gains, model.gains);
  if (const auto envelope = object.Find("envelope")) model.envelope = ReadEnvelope(*envelope);
  return model;
}

}  // namespace

UplinkLoss ReadUplinkLoss(const Value& value) {
  const std::string name = value.Text();
  if (name == "hold") return UplinkLoss::kHoldLevelAfterOneSecond;
  if (name == "keep") return UplinkLoss::kKeepLastCommand;
  value.Refuse(UnknownName("uplink_loss", name, {"hold", "keep"}));
}

LinkQuality ReadLinkQuality(const Value& value, const LinkQuality& otherwise) {
  const Object object(value, {"delay_s", "jitter_s", "loss"});
  return {.delay_s = object.Number("delay_s", {0, 60}, otherwise.delay_s),
          .jitter_s = object.Number("jitter_s", {0, 60}, otherwise.jitter_s),
          .loss = object.Number("loss", {0, 1}, otherwise.loss)};
}

std::map<std::string, VehicleModel> ReadModels(const Value& value) {
  std::map<std::string, VehicleModel> models;
  for (const auto& [name, model] : value.Members()) models[name] = ReadInlineModel(model, name);
  return models;
}

VehicleModel ReadModel(const Value& value, const std::map<std::string, VehicleModel>& models) {
  if (!value.IsText()) return ReadInlineModel(value, "custom");
  const std::string name = value.Text();
  const auto found = models.find(name);
  if (found != models.end()) return found->second;
  if (name == "default") return VehicleModel{};
  std::vector<std::string> names{"default"};
  for (const auto& [known, model] : models) names.push_back(known);
  value.Refuse(UnknownName("model", name, names));
}

VehicleConfig ReadEquipment(const Object& object, const Defaults& defaults) {
  VehicleConfig vehicle;
  if (const auto model = object.Find("model")) vehicle.model = ReadModel(*model, defaults.models);
  object.RefuseBoth("actual_gains", "autopilot_scale");
  if (const auto actual = object.Find("actual_gains")) {
    vehicle.actual = ReadAutopilotGains(*actual, vehicle.model.gains);
  } else {
    const double scale = object.Number("autopilot_scale", {0.1, 10}, defaults.autopilot_scale);
    if (scale != 1) vehicle.actual = Scaled(vehicle.model.gains, scale);
  }
  vehicle.uplink_loss = defaults.uplink_loss;
  if (const auto uplink_loss = object.Find("uplink_loss")) vehicle.uplink_loss = ReadUplinkLoss(*uplink_loss);
  vehicle.uplink = defaults.uplink;
  vehicle.downlink = defaults.downlink;
  if (const auto link = object.Find("link")) {
    const Object directions(*link, {"up", "down"});
    if (const auto up = directions.Find("up")) vehicle.uplink = ReadLinkQuality(*up, defaults.uplink);
    if (const auto down = directions.Find("down"))
      vehicle.downlink = ReadLinkQuality(*down, defaults.downlink);
  }
  vehicle.has_payload = object.Boolean("payload", true);
  return vehicle;
}

VehicleConfig ReadVehicle(const Value& value, const Defaults& defaults) {
  const Object object(
      value, {"id", "callsign", "east_m", "north_m", "up_m", "speed_m_s", "course_deg", "climb_deg", "model",
              "actual_gains", "autopilot_scale", "link", "uplink_loss", "payload"});
  VehicleConfig vehicle = ReadEquipment(object, defaults);
  vehicle.id = object.At("id").Integer(kIds);
  vehicle.callsign = object.Text("callsign", "UAV" + std::to_string(vehicle.id));
  const Envelope& envelope = vehicle.model.envelope;
  const double steepest_deg = envelope.max_climb_rad * 180 / M_PI;
  vehicle.start = {.east_m = object.Number("east_m", kHorizontalM),
                   .north_m = object.Number("north_m", kHorizontalM),
                   .up_m = object.Number("up_m", kUpM),
                   .speed_m_s = object.Number("speed_m_s", {envelope.min_speed_m_s, envelope.max_speed_m_s}),
                   .course_rad = CourseFromCompass(object.Number("course_deg", kCompassDeg)),
                   .climb_rad = object.Number("climb_deg", {-steepest_deg, steepest_deg}, 0) * M_PI / 180};
  return vehicle;
}

}  // namespace skein::config

#include "cli/formation_file.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "bus/conversions.h"
#include "config/readers.h"

namespace skein::cli {
namespace {

std::vector<Slot> ReadSlots(const config::Value& value) {
  std::vector<Slot> slots;
  for (const config::Value& item : value.Items()) {
    const config::Object object(item, {"vehicle", "forward_m", "left_m", "up_m"});
    slots.push_back({.vehicle_id = object.At("vehicle").Integer(config::kIds),
                     .offset = {.forward_m = object.Number("forward_m", config::kHorizontalM),
                                .left_m = object.Number("left_m", config::kHorizontalM),
                                .up_m = object.Number("up_m", {-20e3, 20e3}, 0)}});
  }
  return slots;
}

std::vector<Slot> ShapeMembers(const config::Value& value, const config::FormationConfig& formation) {
  const auto members = value.Items();
  const auto offsets =
      ShapeSlots(formation.shape, static_cast<int>(members.size()), formation.spacing_m, formation.lead_m);
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < members.size(); ++i)
    slots.push_back({members[i].Integer(config::kIds), offsets[i]});
  return slots;
}

}  // namespace

formation_t ReadFormationFile(const std::filesystem::path& file) {
  const config::Object object(config::Value::FromFile(file),
                              {"id", "name", "control", "shape", "spacing_m", "lead_m", "leader", "slots",
                               "vehicles", "proximity", "gains", "path"});
  if (const auto path = object.Find("path")) path->Refuse("is not taken from here: skein path upload");
  if (const auto leader = object.Find("leader"))
    leader->Refuse("is not taken from here: a leader flies on as it does");
  config::FormationConfig config = config::ReadFormationLaw(object, {});
  const bool custom = object.Has("slots") && !object.Has("shape");
  config.shape = custom ? Shape::kCustom : config::ReadShape(object.At("shape"));
  config.slots = config.shape == Shape::kCustom ? ReadSlots(object.At("slots"))
                                                : ShapeMembers(object.At("vehicles"), config);
  formation_t message;
  message.formation_id = object.At("id").Integer(config::kIds);
  message.name = object.Text("name", "Formation " + std::to_string(message.formation_id));
  message.control = config.control;
  message.shape = std::string(Name(config.shape));
  message.spacing_m = config.shape == Shape::kCustom ? 0 : config.spacing_m;
  message.lead_m = config.lead_m;
  bus::SetProximityLimits(message, config.proximity);
  for (const auto& [name, value] : config.gains) {
    message.parameters.emplace_back();
    message.parameters.back().name = name;
    message.parameters.back().value = value;
  }
  message.num_parameters = static_cast<int>(message.parameters.size());
  bus::SetSlots(message, config.slots);
  return message;
}

std::string WriteFormation(const formation_t& formation) {
  nlohmann::ordered_json json = {{"id", formation.formation_id},
                                 {"name", formation.name},
                                 {"control", formation.control},
                                 {"shape", formation.shape}};
  if (formation.shape == "custom") {
    for (const slot_t& slot : formation.slots) {
      json["slots"].push_back({{"vehicle", slot.vehicle_id},
                               {"forward_m", slot.forward_m},
                               {"left_m", slot.left_m},
                               {"up_m", slot.up_m}});
    }
  } else {
    json["spacing_m"] = formation.spacing_m;
    json["lead_m"] = formation.lead_m;
    for (const slot_t& slot : formation.slots) json["vehicles"].push_back(slot.vehicle_id);
  }
  json["proximity"] = {{"radius_m", formation.radius_m},
                       {"height_m", formation.height_m},
                       {"d_mod_m", formation.d_mod_m},
                       {"advisory_tau_s", formation.advisory_tau_s},
                       {"caution_tau_s", formation.caution_tau_s}};
  for (const parameter_t& parameter : formation.parameters) json["gains"][parameter.name] = parameter.value;
  return json.dump(1);
}

}  // namespace skein::cli

#include "controller/formation_message.h"

#include <spdlog/fmt/fmt.h>

#include <set>
#include <stdexcept>

#include "bus/conversions.h"
#include "core/paper_law.h"
#include "core/skein_law.h"

namespace skein::controller {

formation_t FormationMessage(const FormationFlight& flight, bus::Utime utime) {
  const config::FormationConfig& config = flight.config();
  formation_t message;
  message.utime = utime;
  message.formation_id = config.id;
  message.name = config.name;
  message.control = config.control;
  message.shape = std::string(Name(config.shape));
  message.spacing_m = config.shape == Shape::kCustom ? 0 : config.spacing_m;
  message.lead_m = config.lead_m;
  bus::SetProximityLimits(message, config.proximity);
  message.hold = flight.holding();
  for (const auto& [name, value] : config.gains) {
    parameter_t parameter;
    parameter.name = name;
    parameter.value = value;
    message.parameters.push_back(parameter);
  }
  message.num_parameters = static_cast<int>(message.parameters.size());
  bus::SetSlots(message, config.slots);
  return message;
}

path_t PathMessage(const FormationFlight& flight, bus::Utime utime) {
  path_t message = bus::ToMessage(flight.leader().path());
  message.utime = utime;
  message.formation_id = flight.config().id;
  message.path_revision = flight.path_revision();
  bus::SetWaypoints(message, flight.waypoints());
  return message;
}

std::variant<config::FormationConfig, std::string> ToFormationConfig(const formation_t& message) {
  config::FormationConfig config;
  // Nobody would take what is said of it: 0 means none.
  if (message.formation_id < 1)
    return fmt::format("the id of a formation must be 1 or more, not {}", message.formation_id);
  config.id = message.formation_id;
  config.name = message.name;
  config.control = message.control;
  if (config.control != "skein" && config.control != "paper") {
    return fmt::format("control \"{}\" is not known; there are \"skein\" and \"paper\"", config.control);
  }
  const auto shape = ShapeFromName(message.shape);
  if (!shape) return fmt::format("shape \"{}\" is not known", message.shape);
  config.shape = *shape;
  config.spacing_m = message.spacing_m;
  config.lead_m = message.lead_m;
  config.proximity = bus::ToProximityLimits(message);
  config.slots = bus::ToSlots(message);
  if (config.slots.empty()) return std::string("a formation needs at least one slot");
  std::set<int> ids;
  for (const Slot& slot : config.slots) {
    if (!ids.insert(slot.vehicle_id).second) return fmt::format("UAV {} has two slots", slot.vehicle_id);
  }
  for (const parameter_t& parameter : message.parameters) config.gains[parameter.name] = parameter.value;
  try {
    Check(config.proximity);
    if (config.control == "paper") {
      PaperParametersFrom(config.gains);
    } else {
      SkeinLawParametersFrom(config.gains);
    }
  } catch (const std::invalid_argument& error) {
    return std::string(error.what());
  }
  return config;
}

}  // namespace skein::controller

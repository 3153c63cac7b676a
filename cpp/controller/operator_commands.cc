// What operators ask of the controller, and its answers.
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "bus/channels.h"
#include "bus/conversions.h"
#include "controller/controller_node.h"
#include "controller/formation_message.h"

namespace skein::controller {
namespace {

bus::Answer AnswerOf(const std::string& why_not) {
  return why_not.empty() ? bus::Answer::Accepted() : bus::Answer::Refused(why_not);
}

}  // namespace

std::string FormationControllerNode::WhyNotYet() const {
  if (start_utime_ == 0) return "no fleet is known yet: no FLEET_ROSTER has come";
  if (waiting_.empty()) return "";
  return fmt::format("{} formations of the scenario are still to be started: try again in {} s",
                     waiting_.size(), 1 + waiting_.size() / (kStartInAPart * kRepeatParts));
}

bus::Answer FormationControllerNode::OnFormationCommand(const formation_command_t& command) {
  if (const std::string why_not = WhyNotYet(); !why_not.empty()) return bus::Answer::Refused(why_not);
  if (command.action == formation_command_t::ACTION_APPLY) return Apply(command.formation);

  const int id = command.formation.formation_id;
  const auto flight = flights_.find(id);
  if (flight == flights_.end()) return bus::Answer::Refused(fmt::format("there is no formation {}", id));
  std::string why_not;
  switch (command.action) {
    case formation_command_t::ACTION_HOLD:
      why_not = flight->second.Hold(fleet_);
      if (why_not.empty()) Tell(flight->second, {event_t::INFO, "formation_hold", 0, "holds: loiters here"});
      break;
    case formation_command_t::ACTION_RESUME:
      why_not = flight->second.Resume(fleet_);
      if (why_not.empty()) Tell(flight->second, {event_t::INFO, "formation_resumed", 0, "resumes its path"});
      break;
    case formation_command_t::ACTION_REMOVE: {
      Tell(flight->second,
           {event_t::INFO, "formation_removed", 0, "removed; its UAVs hold course and altitude"});
      formation_t gone = FormationMessage(flight->second, bus_.executor().Now());
      gone.slots.clear();
      gone.num_slots = 0;
      flights_.erase(flight);
      bus_.Publish(bus::channel::kFormation, gone);
      SaveStateNow();
      return bus::Answer::Accepted();
    }
    default:
      return bus::Answer::Refused("unknown action");
  }
  if (why_not.empty()) {
    SendFormation(flight->second);
    SaveStateNow();
  }
  return AnswerOf(why_not);
}

bus::Answer FormationControllerNode::Apply(const formation_t& message) {
  const auto read = ToFormationConfig(message);
  if (const auto* why_not = std::get_if<std::string>(&read)) return bus::Answer::Refused(*why_not);
  const auto& config = std::get<config::FormationConfig>(read);
  if (const std::string why_not = WhyNot(config); !why_not.empty()) return bus::Answer::Refused(why_not);

  const auto known = flights_.find(config.id);
  const std::string why_not =
      known == flights_.end() ? StartFlight(config) : known->second.Edit(config, fleet_);
  if (!why_not.empty()) return bus::Answer::Refused(why_not);
  const FormationFlight& flight = flights_.at(config.id);
  const std::string remark = CloseSlots(config);
  Tell(flight, {remark.empty() ? event_t::INFO : event_t::CAUTION, "formation_applied", 0,
                fmt::format("{} of {} UAVs, control {}{}{}", Name(config.shape), config.slots.size(),
                            config.control, remark.empty() ? "" : "; ", remark)});
  SendFormation(flight);
  SaveStateNow();
  return bus::Answer::Accepted(remark);
}

std::string FormationControllerNode::CloseSlots(const config::FormationConfig& config) const {
  const ProximityLimits& limits = config.proximity;
  std::string text;
  int pairs = 0;
  for (std::size_t i = 0; i < config.slots.size(); ++i) {
    for (std::size_t k = i + 1; k < config.slots.size(); ++k) {
      const SlotOffset& one = config.slots[i].offset;
      const SlotOffset& other = config.slots[k].offset;
      const double horizontal = std::hypot(one.forward_m - other.forward_m, one.left_m - other.left_m);
      const double vertical = std::abs(one.up_m - other.up_m);
      if (horizontal >= limits.radius_m || vertical >= limits.height_m) continue;
      if (++pairs > 1) continue;
      text = fmt::format(
          "the slots of {} and {} are {:.0f} m apart and {:.0f} m in height: inside one "
          "another's cylinder",
          fleet_.at(config.slots[i].vehicle_id).callsign, fleet_.at(config.slots[k].vehicle_id).callsign,
          horizontal, vertical);
    }
  }
  return pairs < 2 ? text : fmt::format("{}; so are those of {} more pairs", text, pairs - 1);
}

std::string FormationControllerNode::WhyNot(const config::FormationConfig& config) const {
  for (const Slot& slot : config.slots) {
    if (!fleet_.contains(slot.vehicle_id))
      return fmt::format("there is no UAV {} in the fleet", slot.vehicle_id);
    for (const auto& [id, flight] : flights_) {
      if (id != config.id && flight.HasMember(slot.vehicle_id)) {
        return fmt::format("{} flies in formation {} already", fleet_.at(slot.vehicle_id).callsign, id);
      }
    }
  }
  return "";
}

std::optional<PathPlan> FormationControllerNode::PlanPath(const path_command_t& command) const {
  const auto flight = flights_.find(command.formation_id);
  if (flight == flights_.end()) return std::nullopt;
  return flight->second.PlanPath(bus::ToWaypoints(command), command.closed, fleet_);
}

bus::Answer FormationControllerNode::OnPathCommand(const path_command_t& command) {
  const auto flight = flights_.find(command.formation_id);
  if (flight == flights_.end()) {
    const std::string why_not = WhyNotYet();
    return bus::Answer::Refused(
        why_not.empty() ? fmt::format("there is no formation {}", command.formation_id) : why_not);
  }
  const std::string why_not = flight->second.TakePath(bus::ToWaypoints(command), command.closed, fleet_);
  if (why_not.empty()) {
    Tell(flight->second, {event_t::INFO, "path_taken", 0,
                          command.num_waypoints == 0
                              ? std::string("flies straight on: no path")
                              : fmt::format("flies a new path of {} waypoints", command.num_waypoints)});
    SendFormation(flight->second);
    SaveStateNow();
  }
  return AnswerOf(why_not);
}

}  // namespace skein::controller

// How formations come to be: from the scenario, from where the fleet is, or from the state of an earlier run.
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bus/conversions.h"
#include "controller/controller_node.h"
#include "controller/formation_message.h"
#include "core/frames.h"

namespace skein::controller {
namespace {

Airspace AirspaceOf(const std::optional<config::Scenario>& scenario) {
  Airspace airspace;
  if (scenario) {
    airspace.ceiling_m = scenario->ceiling_m;
    airspace.strangers = scenario->strangers;
  }
  return airspace;
}

PathLimits LimitsOfSlots(const FleetPicture& fleet, const std::vector<Slot>& slots) {
  std::vector<VehicleModel> models;
  std::vector<SlotOffset> offsets;
  for (const Slot& slot : slots) {
    const auto view = fleet.find(slot.vehicle_id);
    if (view != fleet.end()) models.push_back(view->second.model);
    offsets.push_back(slot.offset);
  }
  return LimitsOf(models, offsets);
}

/// The path of a scenario's formation, from its leader's start.
PathResult ScenarioPath(const config::FormationConfig& config, const PathLimits& limits) {
  const config::LeaderConfig& leader = config.leader;
  const Eigen::Vector2d start(leader.east_m, leader.north_m);
  const Path straight = Path::Straight(start, leader.course_rad, leader.up_m, leader.speed_m_s);
  if (!config.path) return {straight, ""};
  if (!config.path->legs.empty()) {
    return PlanLegs(start, leader.course_rad, leader.up_m, leader.speed_m_s, config.path->legs, limits);
  }
  const PathResult planned = PlanWaypoints(config.path->waypoints, config.path->closed, limits);
  if (!planned.path) return planned;
  return Join(straight, straight.start_arc_m(), *planned.path, planned.path->start_arc_m(), 0, limits);
}

}  // namespace

void FormationControllerNode::TakeScenario(const std::string& name, bool again) {
  if (!options_.find_scenario || name.empty()) return;
  if (!again && options_.scenario && options_.scenario->name == name) return;
  auto found = options_.find_scenario(name);
  // At the start an operator may well have meant a scenario that the fleet does not know by name.
  if (!found && !again) return;
  if (!found) {
    events_.Tell(event_t::CAUTION, "scenario_missing",
                 fmt::format("there is no scenario \"{}\" here: its UAVs hold course and altitude until "
                             "formations are set",
                             name));
  }
  options_.scenario = std::move(found);
}

void FormationControllerNode::StartScenario() {
  if (!options_.scenario) return;
  waiting_.assign(options_.scenario->formations.begin(), options_.scenario->formations.end());
  StartWaiting(kStartAtOnce);
}

void FormationControllerNode::StartWaiting(std::size_t most) {
  for (; most > 0 && !waiting_.empty(); --most) {
    StartFromScenario(waiting_.front());
    waiting_.pop_front();
  }
}

void FormationControllerNode::StartFromScenario(const config::FormationConfig& config) {
  PathResult result = ScenarioPath(config, LimitsOfSlots(fleet_, config.slots));
  const std::string refused = result.reason;
  if (!result.path) {
    const config::LeaderConfig& leader = config.leader;
    result.path =
        Path::Straight({leader.east_m, leader.north_m}, leader.course_rad, leader.up_m, leader.speed_m_s);
  }
  const double start_arc = result.path->start_arc_m();
  FormationFlight flight(config, VirtualLeader(*result.path, start_arc, bus::ToSeconds(start_utime_)),
                         AirspaceOf(options_.scenario));
  if (config.path) flight.SetWaypoints(config.path->waypoints);
  const auto& added = flights_.emplace(config.id, std::move(flight)).first->second;
  if (!refused.empty()) {
    Tell(added,
         {event_t::WARNING, "path_refused", 0, "flies straight on: its path cannot be flown: " + refused});
  }
  SendFormation(added);
}

std::string FormationControllerNode::StartFlight(const config::FormationConfig& config) {
  std::string reason;
  auto leader = LeaderOverFleet(config.slots, reason);
  if (!leader) return reason;
  flights_.emplace(config.id, FormationFlight(config, std::move(*leader), AirspaceOf(options_.scenario)));
  return "";
}

std::optional<VirtualLeader> FormationControllerNode::LeaderOverFleet(const std::vector<Slot>& slots,
                                                                      std::string& reason) const {
  // Where the slots lie best over the UAVs as they fly: mean course and speed, mean place.
  Eigen::Vector2d direction(0, 0);
  Eigen::Vector3d place(0, 0, 0);
  double speed = 0;
  double slowest = 0;
  double fastest = 1e9;
  for (const Slot& slot : slots) {
    const VehicleView& view = fleet_.at(slot.vehicle_id);
    if (!view.state) {
      reason = view.callsign + " has not been heard yet";
      return std::nullopt;
    }
    const VehicleState now = view.At(tick_utime_);
    direction += Eigen::Vector2d(std::cos(now.course_rad), std::sin(now.course_rad));
    place += Position(now);
    speed += now.speed_m_s;
    slowest = std::max(slowest, view.model.envelope.min_speed_m_s);
    fastest = std::min(fastest, view.model.envelope.max_speed_m_s);
  }
  const auto count = static_cast<double>(slots.size());
  const double course = direction.norm() > 1e-6 ? std::atan2(direction.y(), direction.x()) : 0;
  place /= count;
  speed = std::clamp(speed / count, 1.1 * slowest, std::max(1.1 * slowest, 0.9 * fastest));
  Eigen::Vector3d offset(0, 0, 0);
  for (const Slot& slot : slots) {
    offset += Eigen::Vector3d(slot.offset.forward_m, slot.offset.left_m, slot.offset.up_m);
  }
  offset /= count;
  const Eigen::Vector2d start = place.head<2>() - FromLeaderFrame(offset.head<2>(), course);
  const Path path = Path::Straight(start, course, place.z() - offset.z(), speed);
  return VirtualLeader(path, path.start_arc_m(), bus::ToSeconds(tick_utime_));
}

std::optional<ControllerState> FormationControllerNode::StateNow() const {
  // Without a roster nothing has been taken up yet, and the file still holds what is to be. Who goes on from
  // the state starts nothing from the scenario: so all must have been started.
  if (!state_file_.kept() || start_utime_ == 0 || tick_utime_ == 0 || !waiting_.empty()) return std::nullopt;
  ControllerState state;
  state.start_utime = start_utime_;
  for (const auto& [id, flight] : flights_) {
    FormationState saved{FormationMessage(flight, tick_utime_), PathMessage(flight, tick_utime_),
                         flight.Status(tick_), std::nullopt, 0};
    if (flight.before_hold()) {
      saved.path_before_hold = bus::ToMessage(flight.before_hold()->path);
      saved.path_before_hold->utime = tick_utime_;
      saved.path_before_hold->formation_id = id;
      saved.arc_before_hold_m = flight.before_hold()->arc_m;
    }
    state.formations.push_back(std::move(saved));
  }
  state.heard.utime = tick_utime_;
  state.heard.chunk_count = 1;
  for (const auto& [id, view] : fleet_) {
    if (view.lost) state.lost.push_back(id);
    if (!view.state) continue;
    vehicle_state_t heard = bus::ToMessage(*view.state);
    heard.utime = view.state_utime;
    heard.id = id;
    heard.command_session_id = heard.command_sequence = 0;
    heard.payload_on = 0;
    state.heard.vehicles.push_back(heard);
  }
  state.heard.num_vehicles = static_cast<int>(state.heard.vehicles.size());
  return state;
}

void FormationControllerNode::SaveState() {
  if (const auto state = StateNow()) state_file_.Save(Encode(*state));
}

void FormationControllerNode::SaveStateNow() {
  if (const auto state = StateNow()) state_file_.SaveNow(Encode(*state));
}

std::optional<ControllerState> FormationControllerNode::ReadState() {
  if (options_.state) return options_.state;
  const auto bytes = state_file_.Read();
  if (!bytes) return std::nullopt;
  auto state = DecodeControllerState(*bytes);
  if (!state) state_file_.SetAside("it holds no state of formations");
  return state;
}

bool FormationControllerNode::RestoreState() {
  const auto state = ReadState();
  if (!state || state->start_utime != start_utime_) return false;
  for (const vehicle_state_t& heard : state->heard.vehicles) {
    const auto view = fleet_.find(heard.id);
    if (view != fleet_.end()) view->second.Take(bus::ToVehicleState(heard), heard.utime, heard.utime);
  }
  for (const int id : state->lost) {
    const auto view = fleet_.find(id);
    if (view != fleet_.end()) view->second.lost = true;
  }
  for (const FormationState& saved : state->formations) {
    const auto config = ToFormationConfig(saved.formation);
    if (!std::holds_alternative<config::FormationConfig>(config) || saved.status.utime == 0) continue;
    try {
      VirtualLeader leader(bus::ToPath(saved.path), saved.status.leader_arc_m,
                           bus::ToSeconds(saved.status.utime));
      FormationFlight flight(std::get<config::FormationConfig>(config), std::move(leader),
                             AirspaceOf(options_.scenario));
      flight.SetWaypoints(bus::ToWaypoints(saved.path));
      flight.SetPathRevision(saved.path.path_revision);
      flight.GoOnFrom(saved.status);
      if (saved.path_before_hold) {
        flight.SetBeforeHold({bus::ToPath(*saved.path_before_hold), saved.arc_before_hold_m});
      }
      flights_.emplace(saved.formation.formation_id, std::move(flight));
    } catch (const std::invalid_argument& error) {
      spdlog::warn("formation {} is not taken up again: {}", saved.formation.formation_id, error.what());
    }
  }
  events_.Tell(event_t::ADVISORY, "controller_restarted",
               fmt::format("the controller is back and goes on with {} formations", flights_.size()));
  return true;
}

}  // namespace skein::controller

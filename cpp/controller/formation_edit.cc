// What an operator changes in flight: slots, path, hold.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "controller/formation_flight.h"
#include "core/frames.h"

namespace skein::controller {
namespace {

constexpr double kShareOfAnEdit = 0.9;   // of the envelope; the rest is left to control
constexpr double kStraightAhead = 3000;  // [m]; room to unwind a turn before a straight path begins

std::vector<SlotOffset> Offsets(const std::vector<Slot>& slots) {
  std::vector<SlotOffset> offsets;
  for (const Slot& slot : slots) offsets.push_back(slot.offset);
  return offsets;
}

}  // namespace

PathLimits FormationFlight::LimitsFor(const FleetPicture& fleet, const std::vector<Slot>& slots,
                                      double share) const {
  std::vector<VehicleModel> models;
  for (const Slot& slot : slots) {
    const auto view = fleet.find(slot.vehicle_id);
    if (view != fleet.end()) models.push_back(view->second.model);
  }
  return LimitsOf(models, Offsets(slots), share);
}

double FormationFlight::KeepBehind() const {
  double hindmost = 0;
  for (const Slot& slot : config_.slots) hindmost = std::min(hindmost, slot.offset.forward_m);
  constexpr double kSpare =
      1500;  // [m]; history of the leader, and a formation edit that reaches farther back
  return kSpare - hindmost;
}

std::string FormationFlight::Edit(const config::FormationConfig& config, const FleetPicture& fleet) {
  for (const auto& [id, member] : members_) {
    const bool stays = std::any_of(config.slots.begin(), config.slots.end(),
                                   [id = id](const Slot& slot) { return slot.vehicle_id == id; });
    // The others keep clear of it, which nobody would once it is no member any more.
    if (!stays && avoidance_.role(id) != Role::kFlying) {
      return fmt::format("UAV {} cannot be taken out before its link is back and it is in place", id);
    }
  }
  // The path was planned for the slots as they were, often right up to the planning limits; a wider formation
  // may use more.
  const std::string violation = Violation(leader_.path(), LimitsFor(fleet, config.slots, kShareOfAnEdit));
  std::optional<Path> wider_circle;
  if (!violation.empty() && before_hold_) {
    wider_circle = Loiter(leader_.path(), leader_.arc_m(), KeepBehind(), LimitsFor(fleet, config.slots)).path;
  }
  if (!violation.empty() && !wider_circle) {
    return "its path cannot be flown in this formation: " + violation;
  }
  const config::FormationConfig before = config_;
  config_ = config;
  std::map<int, Member> members;
  try {
    for (const Slot& slot : config_.slots) {
      const auto known = members_.find(slot.vehicle_id);
      const bool same_law = before.control == config_.control && before.gains == config_.gains;
      Member member = known != members_.end() && same_law ? known->second : MakeMember(slot);
      member.slot = slot.offset;
      members.emplace(slot.vehicle_id, std::move(member));
    }
  } catch (const std::invalid_argument& error) {
    config_ = before;
    return error.what();
  }
  members_ = std::move(members);
  if (wider_circle) {
    leader_.SetPath(*wider_circle);
    ++path_revision_;
  }
  return "";
}

PathPlan FormationFlight::PlanPath(const std::vector<Waypoint>& waypoints, bool closed,
                                   const FleetPicture& fleet) const {
  const PathLimits limits = LimitsFor(fleet, config_.slots);
  const double from = leader_.arc_m();
  PathResult planned;
  if (waypoints.empty()) {
    const PathPoint here = leader_.path().At(from);
    const Eigen::Vector2d ahead = FromLeaderFrame({kStraightAhead + limits.foremost_m, 0}, here.course_rad);
    planned.path = Path::Straight(here.position + ahead, here.course_rad, here.up_m, here.speed_m_s);
  } else {
    planned = PlanWaypoints(waypoints, closed, limits);
  }
  PathPlan plan;
  plan.problems = std::move(planned.problems);
  if (!planned.path) return plan;
  PathResult joined =
      Join(leader_.path(), from, *planned.path, planned.path->start_arc_m(), KeepBehind(), limits);
  if (!joined.path) {
    plan.problems.push_back({0, false, joined.reason});
    return plan;
  }
  plan.path = std::move(joined.path);
  plan.joins_at_m = joined.joins_at_m;
  for (const double arc : planned.waypoint_arcs_m) {
    // What lies before the place of joining comes at the end of the lap, or is where the two meet.
    const double lap = plan.path->lap_m();
    double passed = arc + joined.shift_m;
    if (lap > 0) passed += lap * std::ceil((plan.joins_at_m - passed) / lap);
    plan.waypoint_arcs_m.push_back(std::max(passed, plan.joins_at_m));
  }
  return plan;
}

std::string FormationFlight::TakePath(const std::vector<Waypoint>& waypoints, bool closed,
                                      const FleetPicture& fleet) {
  PathPlan plan = PlanPath(waypoints, closed, fleet);
  if (!plan.path) return plan.problems.front().text;
  leader_.SetPath(std::move(*plan.path));
  waypoints_ = waypoints;
  before_hold_.reset();
  ++path_revision_;
  return "";
}

std::string FormationFlight::Hold(const FleetPicture& fleet) {
  if (before_hold_) return "";
  const PathLimits limits = LimitsFor(fleet, config_.slots);
  const PathResult circle = Loiter(leader_.path(), leader_.arc_m(), KeepBehind(), limits);
  if (!circle.path) return circle.reason;
  before_hold_ = PathBeforeHold{leader_.path(), leader_.arc_m()};
  leader_.SetPath(*circle.path);
  ++path_revision_;
  return "";
}

std::string FormationFlight::Resume(const FleetPicture& fleet) {
  if (!before_hold_) return "it does not hold";
  const PathLimits limits = LimitsFor(fleet, config_.slots);
  const PathResult joined =
      Join(leader_.path(), leader_.arc_m(), before_hold_->path, before_hold_->arc_m, KeepBehind(), limits);
  if (!joined.path) return joined.reason;
  leader_.SetPath(*joined.path);
  before_hold_.reset();
  ++path_revision_;
  return "";
}

}  // namespace skein::controller

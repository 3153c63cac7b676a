#include "experiment/summary.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/frames.h"

namespace skein::experiment {
namespace {

// Beyond this, pairs are looked at once a second only: nothing comes much nearer in between.
constexpr std::size_t kManyVehicles = 200;
constexpr std::size_t kFewVehicles = 10;

std::string ControlsOf(const config::Scenario& scenario) {
  std::set<std::string> controls;
  for (const auto& formation : scenario.formations) controls.insert(formation.control);
  std::string text;
  for (const auto& control : controls) text += (text.empty() ? "" : ", ") + control;
  return text;
}

/// Time since which |error| has been within the limit.
std::optional<double> StillWithin(std::optional<double> since, double error, double limit, double t_s) {
  if (std::abs(error) > limit) return std::nullopt;
  return since ? since : t_s;
}

}  // namespace

bool InSlot(const slot_status_t& slot) {
  return std::max({std::abs(slot.forward_error_m), std::abs(slot.left_error_m), std::abs(slot.up_error_m)}) <=
         Settling::kPositionM;
}

SummaryBuilder::SummaryBuilder(const config::Scenario& scenario) {
  summary_.scenario = scenario.name;
  summary_.control = ControlsOf(scenario);
  for (const auto& vehicle : scenario.vehicles) {
    VehicleSummary summary;
    summary.id = vehicle.id;
    summary.callsign = vehicle.callsign;
    summary.least_speed_m_s = summary.greatest_speed_m_s = vehicle.start.speed_m_s;
    summary_.vehicles.push_back(summary);
  }
  last_slots_.resize(summary_.vehicles.size());
  if (summary_.vehicles.size() > kManyVehicles) ticks_between_distances_ = 20;
}

void SummaryBuilder::Add(const Tick& tick) {
  summary_.duration_s = tick.t_s;
  for (const event_t& event : tick.events) summary_.events.push_back({tick.t_s, event});
  for (const VehicleTick& vehicle : tick.vehicles) WatchLink(vehicle, tick.t_s);
  for (std::size_t i = 0; i < tick.vehicles.size(); ++i) {
    const VehicleTick& vehicle = tick.vehicles[i];
    VehicleSummary& summary = summary_.vehicles[i];
    summary.least_speed_m_s = std::min(summary.least_speed_m_s, vehicle.truth.speed_m_s);
    summary.greatest_speed_m_s = std::max(summary.greatest_speed_m_s, vehicle.truth.speed_m_s);
    if (vehicle.level() > summary.highest_level) {
      summary.highest_level = vehicle.level();
      summary.highest_level_s = tick.t_s;
      summary.highest_level_with_id = vehicle.proximity->level_with_id;
    }
    if (vehicle.slot) WatchErrors(tick, i);
    last_slots_[i] = vehicle.slot;
  }
  if (tick.number % ticks_between_distances_ == 0) WatchDistances(tick);
  last_t_s_ = tick.t_s;
}

void SummaryBuilder::WatchErrors(const Tick& tick, std::size_t index) {
  const VehicleTick& vehicle = tick.vehicles[index];
  const slot_status_t& slot = *vehicle.slot;
  VehicleSummary& summary = summary_.vehicles[index];
  summary.in_formation = true;
  summary.greatest_error_m = std::max(summary.greatest_error_m,
                                      std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m));
  if (!summary_.drops.empty()) return;
  Settling& settling = summary.settling;
  settling.forward_s = StillWithin(settling.forward_s, slot.forward_error_m, Settling::kPositionM, tick.t_s);
  settling.left_s = StillWithin(settling.left_s, slot.left_error_m, Settling::kPositionM, tick.t_s);
  settling.up_s = StillWithin(settling.up_s, slot.up_error_m, Settling::kPositionM, tick.t_s);

  // In a turn every slot has a speed of its own, so it is taken from how the slot moves.
  const auto& last = last_slots_[index];
  const double slot_speed_m_s =
      last ? std::hypot(slot.slot_east_m - last->slot_east_m, slot.slot_north_m - last->slot_north_m,
                        slot.slot_up_m - last->slot_up_m) /
                 (tick.t_s - last_t_s_)
           : tick.formations.at(vehicle.formation_id).leader_speed_m_s;
  settling.speed_s =
      StillWithin(settling.speed_s, slot_speed_m_s - vehicle.truth.speed_m_s, Settling::kSpeedMS, tick.t_s);
}

void SummaryBuilder::WatchLink(const VehicleTick& vehicle, double t_s) {
  const auto last = std::find_if(summary_.drops.rbegin(), summary_.drops.rend(),
                                 [&](const LinkDrop& drop) { return drop.vehicle_id == vehicle.id; });
  const bool cut = vehicle.uplink_cut || vehicle.downlink_cut;
  if (last == summary_.drops.rend() || last->restored_s) {
    if (cut) {
      LinkDrop drop;
      drop.vehicle_id = vehicle.id;
      drop.uplink = vehicle.uplink_cut;
      drop.downlink = vehicle.downlink_cut;
      drop.cut_s = t_s;
      drop.told_lost_before = vehicle.link() == Link::kLost;
      summary_.drops.push_back(drop);
      return;
    }
    if (last == summary_.drops.rend()) return;
  }
  if (!last->restored_s && !cut) last->restored_s = t_s;
  if (vehicle.link() != Link::kLost) {
    last->told_lost_before = false;
  } else if (!last->told_lost_before && !last->found_s) {
    last->found_s = t_s;
  }
  if (last->found_s && !last->seen_up_s && vehicle.link() == Link::kUp) last->seen_up_s = t_s;
  if (last->seen_up_s && vehicle.slot) {
    last->in_slot_s = InSlot(*vehicle.slot) ? std::optional(last->in_slot_s.value_or(t_s)) : std::nullopt;
  }
}

void SummaryBuilder::WatchDistances(const Tick& tick) {
  const bool every_pair = tick.vehicles.size() <= kFewVehicles;
  std::size_t pair = 0;
  std::vector<Eigen::Vector3d> positions;
  for (const VehicleTick& vehicle : tick.vehicles) positions.push_back(Position(vehicle.truth));
  for (std::size_t i = 0; i < tick.vehicles.size(); ++i) {
    for (std::size_t k = i + 1; k < tick.vehicles.size(); ++k) {
      const Eigen::Vector3d apart = positions[k] - positions[i];
      const std::size_t index = every_pair ? pair++ : 0;
      const bool is_first = index >= summary_.approaches.size();
      if (is_first) summary_.approaches.emplace_back();
      Approach& least = summary_.approaches[index];
      const double distance_m = apart.norm();
      if (!is_first && distance_m >= least.distance_m) continue;
      least = {tick.vehicles[i].id,    tick.vehicles[k].id, distance_m,
               apart.head<2>().norm(), std::abs(apart.z()), tick.t_s};
    }
  }
}

}  // namespace skein::experiment

#include "experiment/preview_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/frames.h"
#include "experiment/summary.h"

namespace skein::experiment {
namespace {

constexpr std::size_t kManyPairs = 5'000;
constexpr std::int64_t kMostTicksBetweenLooks = 20;

/// A law keeps 2 m/s of the envelope free, so a UAV this near to a speed limit has no more.
constexpr double kSpeedRoom_m_s = 2.5;
constexpr double kAtLimit = 0.99;
constexpr double kLeastSeconds = 0.5;

}  // namespace

CylinderWatch::CylinderWatch(std::set<int> matters, std::map<int, int> formation_of, ProximityRules rules,
                             std::set<int> unknown)
    : matters_(std::move(matters)),
      formation_of_(std::move(formation_of)),
      rules_(std::move(rules)),
      unknown_(std::move(unknown)) {}

void CylinderWatch::MakeRows(const Tick& tick) {
  const auto traffic = [&](std::size_t index) {
    Traffic one;
    one.id = tick.vehicles[index].id;
    const auto formation = formation_of_.find(one.id);
    if (formation != formation_of_.end()) one.formation_id = formation->second;
    return one;
  };
  for (std::size_t i = 0; i < tick.vehicles.size(); ++i) {
    const Traffic one = traffic(i);
    if (!matters_.contains(one.id) || unknown_.contains(one.id)) continue;
    Row row{i, {}};
    for (std::size_t k = 0; k < tick.vehicles.size(); ++k) {
      const Traffic other = traffic(k);
      // A pair of two who matter is looked at once.
      if (k == i || unknown_.contains(other.id) || (k < i && matters_.contains(other.id))) continue;
      const ProximityLimits& limits = rules_.Between(one, other);
      row.others.push_back({k, limits.radius_m, limits.height_m});
    }
    pairs_ += row.others.size();
    rows_.push_back(std::move(row));
  }
  // Large fleets are looked at less often: up to once a second.
  ticks_between_looks_ =
      std::min<std::int64_t>(kMostTicksBetweenLooks, 1 + static_cast<std::int64_t>(pairs_ / kManyPairs));
}

void CylinderWatch::Add(const Tick& tick, double t_s) {
  if (rows_.empty()) MakeRows(tick);
  if (tick.number % ticks_between_looks_ != 0) return;
  const bool every_pair = pairs_ <= kManyPairs;
  std::size_t pair = 0;
  for (const Row& row : rows_) {
    const VehicleTick& one = tick.vehicles[row.index];
    for (const Other& to : row.others) {
      const VehicleTick& other = tick.vehicles[to.index];
      const Separation apart = Separate(Position(one.truth), Position(other.truth));
      const double cylinders = std::max(apart.horizontal_m / to.radius_m, apart.vertical_m / to.height_m);
      const std::size_t index = every_pair ? pair++ : 0;
      const bool is_first = index >= approaches_.size();
      if (is_first) approaches_.emplace_back();
      if (!is_first && cylinders >= approaches_[index].cylinders) continue;
      const auto [first, second] = std::minmax(one.id, other.id);
      approaches_[index] = {first, second, apart.horizontal_m, apart.vertical_m, t_s, cylinders};
    }
  }
}

std::vector<CylinderApproach> CylinderWatch::Worst(std::size_t most) const {
  std::vector<CylinderApproach> worst = approaches_;
  std::stable_sort(worst.begin(), worst.end(),
                   [](const auto& one, const auto& other) { return one.cylinders < other.cylinders; });
  if (worst.size() > most) worst.resize(most);
  return worst;
}

void SlotWatch::Add(const Tick& tick, double t_s) {
  const auto formation = tick.formations.find(formation_id_);
  bool in = false;
  if (formation != tick.formations.end()) {
    const formation_status_t& status = formation->second;
    const bool climbs = std::abs(status.avoidance_target_m - status.avoidance_up_m) > Settling::kPositionM;
    for (const slot_status_t& slot : status.slots) {
      if (!slot.flown) continue;
      in = !climbs && InSlot(slot);
      if (!in) break;
    }
  }
  if (!in) {
    since_s_.reset();
  } else if (!since_s_) {
    since_s_ = t_s;
  }
}

void LimitWatch::Add(const Tick& tick, double t_s, double step_s) {
  for (const VehicleTick& vehicle : tick.vehicles) {
    const auto model = models_.find(vehicle.id);
    if (model == models_.end() || !vehicle.command || !vehicle.slot || !vehicle.slot->flown) continue;
    if (InSlot(*vehicle.slot)) continue;
    const Envelope& envelope = model->second.envelope;
    const vehicle_command_t& command = *vehicle.command;
    const AutopilotRates rates =
        Respond(vehicle.truth, {command.speed_input_m_s, command.course_input_rad, command.climb_input_rad},
                model->second);
    const auto note = [&, id = vehicle.id](const char* limit, bool binds) {
      if (!binds) return;
      BindingLimit& found = found_.try_emplace({id, limit}, BindingLimit{id, limit, t_s, 0}).first->second;
      found.seconds += step_s;
    };
    const auto at = [](double value, double limit) { return std::abs(value) >= kAtLimit * limit; };
    note("min_speed", vehicle.truth.speed_m_s <= envelope.min_speed_m_s + kSpeedRoom_m_s);
    note("max_speed", vehicle.truth.speed_m_s >= envelope.max_speed_m_s - kSpeedRoom_m_s);
    note("acceleration", at(rates.acceleration_m_s2, envelope.max_acceleration_m_s2));
    note("course_rate", at(rates.course_rate_rad_s, envelope.max_course_rate_rad_s));
    // A law commands 95% of the steepest climb at most.
    note("climb", std::abs(vehicle.truth.climb_rad) >= 0.94 * envelope.max_climb_rad);
    note("climb_rate", at(rates.climb_rate_rad_s, envelope.max_climb_rate_rad_s));
  }
}

std::vector<BindingLimit> LimitWatch::Binding() const {
  std::vector<BindingLimit> binding;
  for (const auto& [key, limit] : found_) {
    if (limit.seconds >= kLeastSeconds) binding.push_back(limit);
  }
  std::stable_sort(binding.begin(), binding.end(),
                   [](const auto& one, const auto& other) { return one.seconds > other.seconds; });
  return binding;
}

}  // namespace skein::experiment

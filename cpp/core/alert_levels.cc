#include "core/alert_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double kBetter = 1.25;                 // hysteresis of the way out
constexpr std::int64_t kLeaveAfter = 4'000'000;  // [us]
constexpr unsigned kHistoryMask = 0b1111;        // sweeps that the way in looks at

struct TimeSpan {
  double from_s = 0;
  double to_s = 0;
};
constexpr TimeSpan kAlways{0, std::numeric_limits<double>::infinity()};
constexpr TimeSpan kNever{0, 0};

/// When |position + velocity t| < bound on one axis.
TimeSpan WithinBand(double position, double velocity, double bound) {
  if (velocity == 0) return std::abs(position) < bound ? kAlways : kNever;
  const double one = (-bound - position) / velocity;
  const double other = (bound - position) / velocity;
  return {std::min(one, other), std::max(one, other)};
}

/// The same with the horizontal distance.
TimeSpan WithinCircle(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double radius) {
  const double a = velocity.x() * velocity.x() + velocity.y() * velocity.y();
  const double b = position.x() * velocity.x() + position.y() * velocity.y();
  const double c = position.x() * position.x() + position.y() * position.y() - radius * radius;
  if (a == 0) return c < 0 ? kAlways : kNever;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return kNever;
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

bool Inside(const Separation& separation, double radius_m, double height_m) {
  return separation.horizontal_m < radius_m && separation.vertical_m < height_m;
}

/// Limits that a pair must keep for a while before its level ends.
ProximityLimits Relaxed(ProximityLimits limits) {
  limits.radius_m *= kBetter;
  limits.height_m *= kBetter;
  limits.d_mod_m *= kBetter;
  limits.advisory_tau_s *= kBetter;
  limits.caution_tau_s *= kBetter;
  limits.min_closing_m_s /= kBetter;
  return limits;
}

std::uint64_t Key(int first_id, int second_id) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(first_id)) << 32 |
         static_cast<std::uint32_t>(second_id);
}
int FirstId(std::uint64_t key) { return static_cast<int>(key >> 32); }
int SecondId(std::uint64_t key) { return static_cast<int>(key & 0xffffffff); }

bool ById(const PairAlert& one, const PairAlert& other) {
  return Key(one.first_id, one.second_id) < Key(other.first_id, other.second_id);
}

}  // namespace

bool EntersCylinder(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double radius_m,
                    double height_m) {
  const TimeSpan circle = WithinCircle(position, velocity, radius_m);
  const TimeSpan band = WithinBand(position.z(), velocity.z(), height_m);
  return std::max({circle.from_s, band.from_s, 0.0}) < std::min(circle.to_s, band.to_s);
}

AlertLevel Assess(const Traffic& one, const Traffic& other, const ProximityLimits& limits) {
  const Separation separation = Separate(one.position, other.position);
  if (Inside(separation, limits.radius_m, limits.height_m)) return AlertLevel::kWarning;

  const double horizontal_m = one.horizontal_uncertainty_m + other.horizontal_uncertainty_m;
  const double vertical_m = one.vertical_uncertainty_m + other.vertical_uncertainty_m;
  const double radius_m = limits.radius_m + horizontal_m;
  const double height_m = limits.height_m + vertical_m;
  if (Inside(separation, radius_m, height_m)) return AlertLevel::kCaution;

  const PairMotion motion = MotionBetween(one, other);
  if (motion.closing_m_s <= limits.min_closing_m_s) return AlertLevel::kClear;
  const std::optional<double> tau_s = Tau(motion, limits.d_mod_m + horizontal_m, limits.min_closing_m_s);
  if (!tau_s || *tau_s >= limits.advisory_tau_s) return AlertLevel::kClear;
  if (!EntersCylinder(other.position - one.position, other.velocity - one.velocity, radius_m, height_m)) {
    return AlertLevel::kClear;
  }
  return *tau_s < limits.caution_tau_s ? AlertLevel::kCaution : AlertLevel::kAdvisory;
}

std::vector<std::pair<int, int>> FindConflictsByBruteForce(const std::vector<Traffic>& fleet,
                                                           const ProximityRules& rules) {
  std::vector<std::pair<int, int>> result;
  const int count = static_cast<int>(fleet.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      if (Assess(fleet[i], fleet[j], rules.Between(fleet[i], fleet[j])) != AlertLevel::kClear) {
        result.emplace_back(i, j);
      }
    }
  }
  return result;
}

std::vector<std::pair<int, int>> FindConflicts(const ProximityIndex& index) {
  const std::vector<Traffic>& fleet = index.fleet();
  const ProximityRules& rules = index.rules();
  return index.FindPairs([&](int i, int j) {
    return Assess(fleet[i], fleet[j], rules.Between(fleet[i], fleet[j])) != AlertLevel::kClear;
  });
}

AlertLevel AlertLevels::PairState::level() const {
  for (int level = 3; level >= 1; --level) {
    if (latches[level - 1].on) return static_cast<AlertLevel>(level);
  }
  return AlertLevel::kClear;
}

bool AlertLevels::PairState::idle() const {
  return std::all_of(latches.begin(), latches.end(),
                     [](const Latch& latch) { return !latch.on && latch.history == 0; });
}

void AlertLevels::Update(PairState& state, std::int64_t utime, AlertLevel now, AlertLevel relaxed) {
  for (int level = 1; level <= 3; ++level) {
    Latch& latch = state.latches[level - 1];
    latch.history = (latch.history << 1 | (static_cast<int>(now) >= level ? 1U : 0U)) & kHistoryMask;
    const int needed = level == 3 ? 1 : 2;
    if (!latch.on) {
      // The newest sweep has to be one of them: an old pair of bad samples must not raise what is over.
      latch.on = (latch.history & 1U) != 0 && std::popcount(latch.history) >= needed;
      latch.better_since_utime.reset();
    } else if (static_cast<int>(relaxed) >= level) {
      latch.better_since_utime.reset();
    } else {
      if (!latch.better_since_utime) latch.better_since_utime = utime;
      latch.on = utime - *latch.better_since_utime < kLeaveAfter;
    }
  }
  state.worst = std::max(state.worst, state.level());
}

std::vector<AlertChange> AlertLevels::Sweep(std::int64_t utime, const ProximityIndex& index) {
  const std::vector<Traffic>& fleet = index.fleet();
  const ProximityRules& rules = index.rules();
  std::unordered_map<int, const Traffic*> by_id;
  for (const Traffic& uav : fleet) by_id[uav.id] = &uav;
  for (const auto& [i, j] : FindConflicts(index)) {
    const auto [first_id, second_id] = std::minmax(fleet[i].id, fleet[j].id);
    pairs_.try_emplace(Key(first_id, second_id));
  }

  std::vector<AlertChange> changes;
  for (auto entry = pairs_.begin(); entry != pairs_.end();) {
    PairState& state = entry->second;
    const AlertLevel before = state.level();
    const auto first = by_id.find(FirstId(entry->first));
    const auto second = by_id.find(SecondId(entry->first));
    if (first == by_id.end() || second == by_id.end()) {
      state.latches = {};
    } else {
      const ProximityLimits& limits = rules.Between(*first->second, *second->second);
      Update(state, utime, Assess(*first->second, *second->second, limits),
             Assess(*first->second, *second->second, Relaxed(limits)));
    }
    const AlertLevel level = state.level();
    if (level != before) {
      changes.push_back({{FirstId(entry->first), SecondId(entry->first), level, state.worst}, before});
    }
    if (level == AlertLevel::kClear) state.worst = AlertLevel::kClear;
    entry = state.idle() ? pairs_.erase(entry) : std::next(entry);
  }
  std::sort(changes.begin(), changes.end(),
            [](const AlertChange& one, const AlertChange& other) { return ById(one.pair, other.pair); });
  return changes;
}

std::vector<PairAlert> AlertLevels::active() const {
  std::vector<PairAlert> result;
  for (const auto& [key, state] : pairs_) {
    if (state.level() != AlertLevel::kClear) {
      result.push_back({FirstId(key), SecondId(key), state.level(), state.worst});
    }
  }
  std::sort(result.begin(), result.end(), ById);
  return result;
}

}  // namespace skein

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/proximity.h"
#include "core/proximity_index.h"

namespace skein {

/// Levels as TCAS has them; the numbers are those of PROXIMITY.
enum class AlertLevel { kClear = 0, kAdvisory = 1, kCaution = 2, kWarning = 3 };

/// Whether straight flight from here takes two UAVs into one another's cylinder, now or at any later time.
/// @param position of one relative to the other, ENU [m]. @param velocity likewise [m/s].
bool EntersCylinder(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double radius_m,
                    double height_m);

/// Level of a pair by this instant alone, without memory:
///   kWarning   inside the cylinder, whatever the velocities
///   kCaution   closing faster than V_min, Tau < caution_tau_s, and straight flight enters the cylinder;
///              or inside the cylinder as the uncertainty of a lost UAV enlarges it: uncertainty never warns
///              by itself
///   kAdvisory  as kCaution, with Tau < advisory_tau_s
/// For these the cylinder and D_mod are wider by the uncertainties of both.
AlertLevel Assess(const Traffic& one, const Traffic& other, const ProximityLimits& limits);

/// Places in the fleet (first < second, in order) of all pairs whose Assess() is not kClear.
std::vector<std::pair<int, int>> FindConflicts(const ProximityIndex& index);
/// The same by looking at every pair: the answer that the faster search must give exactly.
std::vector<std::pair<int, int>> FindConflictsByBruteForce(const std::vector<Traffic>& fleet,
                                                           const ProximityRules& rules);

/// A pair that has a level.
struct PairAlert {
  int first_id = 0;  ///< < second_id
  int second_id = 0;
  AlertLevel level = AlertLevel::kClear;
  AlertLevel worst = AlertLevel::kClear;  ///< since it was last clear
};

/// A pair whose level has changed in a sweep.
struct AlertChange {
  PairAlert pair;
  AlertLevel before = AlertLevel::kClear;
};

/// Gives the levels a memory, so that they neither flicker nor come late. For each pair and level:
///
///   off --(assessed so in 2 of the last 4 sweeps; a warning: in this one)--> on
///   on --(1.25 times better than its thresholds for 4 s without a break)--> off
///
/// The entry counts sweeps (it is there to pass over a single bad sample), the way out counts time: the same
/// at any rate of sweeps. Only pairs that are on, or were lately assessed so, are remembered.
class AlertLevels {
 public:
  /// One sweep of the fleet in the index, which is all at one instant. @param utime of that instant [us],
  /// rising.
  /// @return the pairs whose level has changed, by ids. Those with a UAV that is gone from the fleet are
  /// clear.
  std::vector<AlertChange> Sweep(std::int64_t utime, const ProximityIndex& index);

  /// The pairs with a level, by ids.
  std::vector<PairAlert> active() const;

 private:
  struct Latch {
    unsigned history = 0;  ///< one bit a sweep, the latest lowest
    bool on = false;
    std::optional<std::int64_t>
        better_since_utime;  ///< first sweep of those that were 1.25 times better [us]
  };
  struct PairState {
    std::array<Latch, 3> latches;  ///< advisory, caution, warning
    AlertLevel worst = AlertLevel::kClear;

    AlertLevel level() const;
    bool idle() const;
  };
  static void Update(PairState& state, std::int64_t utime, AlertLevel now, AlertLevel relaxed);

  std::unordered_map<std::uint64_t, PairState> pairs_;  ///< by both ids, the smaller one in the upper half
};

}  // namespace skein

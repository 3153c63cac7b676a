#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace skein {

/// Thresholds of one kind of pair: members of one formation, who are close on purpose, or strangers.
struct ProximityLimits {
  double radius_m = 150;       ///< R of the cylinder, a radius (not a diameter), > 0
  double height_m = 50;        ///< H of the cylinder, > 0: inside means |dz| < H and horizontal distance < R
  double d_mod_m = 150;        ///< D_mod of eq. (3) of [1], >= radius_m
  double advisory_tau_s = 30;  ///< > caution_tau_s
  double caution_tau_s = 15;   ///< > 0
  double min_closing_m_s = 1;  ///< V_min of eq. (3), > 0
};
/// Defaults for UAVs that are not in one formation: R = D_mod = 500 m, H 100 m, Tau 55 / 25 s.
ProximityLimits StrangerLimits();
/// Throws std::invalid_argument naming the field and the reason (D_mod < R among them: the levels would come
/// in the wrong order).
void Check(const ProximityLimits& limits);

/// A UAV as the others see it. A fleet is a list of these, all at one instant, ids unique.
struct Traffic {
  int id = 0;                         ///< 1 or more
  Eigen::Vector3d position{0, 0, 0};  ///< ENU [m]
  Eigen::Vector3d velocity{0, 0, 0};  ///< ENU [m/s]
  int formation_id = 0;               ///< 0: of no formation
  double horizontal_uncertainty_m =
      0;  ///< of a dead-reckoned position; touches levels only, never distances and Tau
  double vertical_uncertainty_m = 0;  ///< the same, up and down
};

/// Which thresholds hold for which pair.
struct ProximityRules {
  ProximityLimits strangers = StrangerLimits();
  std::map<int, ProximityLimits>
      formations;  ///< by formation id; a formation that is missing here is strangers

  const ProximityLimits& Between(const Traffic& one, const Traffic& other) const;
  /// Every field the largest of all sets: no pair has a wider threshold.
  ProximityLimits Widest() const;
};

/// Horizontal R and vertical H between two points, as Fig. 1 of [1] means them.
struct Separation {
  double horizontal_m = 0;
  double vertical_m = 0;
};
Separation Separate(const Eigen::Vector3d& one, const Eigen::Vector3d& other);

/// How two UAVs move towards or away from one another. The same, to the last bit, whichever is named first.
struct PairMotion {
  double range_m = 0;      ///< d of eq. (3), 3-D distance
  double closing_m_s = 0;  ///< -d', from the velocities; negative while opening, 0 at range 0
};
PairMotion MotionBetween(const Traffic& one, const Traffic& other);

/// Tau = (d - D_mod^2 / d) / max(-d', V_min), eq. (3) of [1] [s]. 0 where d <= D_mod; none unless the pair
/// closes. Two at one point have met: 0, whatever their velocities.
std::optional<double> Tau(const PairMotion& motion, double d_mod_m, double min_closing_m_s);

struct NearestUav {
  int id = 0;
  Separation separation;
  bool operator==(const NearestUav&) const;
};
struct LeastTau {
  int id = 0;
  double tau_s = 0;
  bool operator==(const LeastTau&) const = default;
};
struct VehicleProximity {
  int id = 0;
  std::optional<NearestUav> nearest;  ///< by 3-D distance, the smaller id of equals; none: it is alone
  std::optional<LeastTau> least_tau;  ///< the smaller id of equals; none: nobody closes
  bool operator==(const VehicleProximity&) const = default;
};

/// Nearest other and least Tau of every UAV, in the order of the fleet. By an index (core/proximity_index.h),
/// which who asks again and again keeps.
std::vector<VehicleProximity> FindProximity(const std::vector<Traffic>& fleet, const ProximityRules& rules);
/// The same by looking at every pair: the answer that the faster search must give exactly.
std::vector<VehicleProximity> FindProximityByBruteForce(const std::vector<Traffic>& fleet,
                                                        const ProximityRules& rules);

}  // namespace skein

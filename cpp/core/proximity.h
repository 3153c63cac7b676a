#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace skein {

/// Thresholds of one kind of pair. DESIGN: members of one formation, and strangers.
struct ProximityLimits {
  double radius_m = 150;        ///< R of the cylinder
  double height_m = 50;         ///< H of the cylinder: inside means |dz| < H and horizontal distance < R
  double d_mod_m = 150;         ///< D_mod of eq. (3) of [1], >= radius_m
  double advisory_tau_s = 30;   ///< > caution_tau_s
  double caution_tau_s = 15;    ///< > 0
  double min_closing_m_s = 1;   ///< V_min of eq. (3), > 0
};
/// Defaults for UAVs that are not in one formation: R = D_mod = 500 m, H 100 m, Tau 55 / 25 s.
ProximityLimits StrangerLimits();
/// Throws std::invalid_argument naming the field and the reason (D_mod < R among them).
void Check(const ProximityLimits& limits);

/// Horizontal R and vertical H between two points, as eq. (3)'s cylinder means them.
struct Separation {
  double horizontal_m = 0;
  double vertical_m = 0;
};

}  // namespace skein

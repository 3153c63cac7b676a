#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/proximity.h"

namespace skein::controller {

/// Somebody who flies apart from a formation's main body: a member whose link is lost or who rejoins.
struct SeparatedMember {
  double level_m = 0;  ///< its height over the altitude planned for it
};

/// An aircraft that the formation has no say over.
struct Traffic {
  Eigen::Vector3d position{0, 0, 0};
  Eigen::Vector3d velocity{0, 0, 0};
};

/// What limits the choice of an altitude offset.
struct AirspaceLimits {
  double clearance_m = 120;    ///< least height between the main body and a separated member
  double highest_m = 1e9;      ///< highest offset that keeps every member below the ceiling
  double lowest_m = -1e9;      ///< lowest offset that keeps every member clear of the ground
  double climb_rate_m_s = 10;  ///< that every member can fly beside the path's own climb, > 0
  ProximityLimits strangers;   ///< cylinder of other traffic
};

/// True when no stranger is, or is about to be, where the body would climb or descend through or stay.
bool FreeOfTraffic(double now_m, double offset_m, const std::vector<Traffic>& body,
                   const std::vector<Traffic>& strangers, const ProximityLimits& limits);

/// The offset that the main body of a formation takes while members are separated: 200 m above them, or less,
/// or below, whatever is free; the present target when that is free still. None when nothing is.
/// @param body positions and velocities of those who would climb, at their present offset `now_m`.
std::optional<double> ChooseOffset(double now_m, double target_m,
                                   const std::vector<SeparatedMember>& separated,
                                   const std::vector<Traffic>& body, const std::vector<Traffic>& strangers,
                                   const AirspaceLimits& limits);

}  // namespace skein::controller

#pragma once

#include <Eigen/Core>

#include "core/vehicle.h"

namespace skein {

/// Where a UAV is thought to be, and how far off that may be.
struct Estimate {
  Eigen::Vector3d position{0, 0, 0};    ///< ENU [m]
  Eigen::Vector3d velocity{0, 0, 0};    ///< ENU [m/s]
  double horizontal_uncertainty_m = 0;  ///< radius
  double vertical_uncertainty_m = 0;    ///< up and down
};

/// How fast, and how far, the trust in an old position fades.
struct UncertaintyGrowth {
  double horizontal_m_s = 2;
  double vertical_m_s = 1;
  double most_horizontal_m = 300;
  double most_vertical_m = 50;
};
/// Throws std::invalid_argument naming the field unless all are finite and >= 0.
void Check(const UncertaintyGrowth& growth);

/// Carries a state on to the present: on its course at its speed; climbing or sinking for one second more,
/// level after that. That is what a UAV without an uplink does by default, and over the delay of a working
/// link it is straight on.
/// @param age_s of the state, >= 0. @param silent_s for how long its source has given no fresh state, >= 0; 0
/// leaves no uncertainty.
Estimate DeadReckon(const VehicleState& state, double age_s, double silent_s,
                    const UncertaintyGrowth& growth = {});

}  // namespace skein

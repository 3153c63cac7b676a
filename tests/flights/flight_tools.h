#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "config/scenario.h"
#include "core/frames.h"
#include "experiment/experiment.h"

namespace skein::flights {

/// A scenario that ships.
inline config::Scenario Shipped(const std::string& name) {
  return config::LoadScenario(std::string(SKEIN_SOURCE_DIR) + "/scripts/scenarios/" + name);
}

/// Slot minus true position at one instant [m], in the horizontal frame of `course_rad`: forward, left, up.
inline Eigen::Vector3d TrueError(const experiment::VehicleTick& uav, double course_rad) {
  const Eigen::Vector3d difference =
      Eigen::Vector3d(uav.slot->slot_east_m, uav.slot->slot_north_m, uav.slot->slot_up_m) -
      Position(uav.truth);
  Eigen::Vector3d error;
  error.head<2>() = ToLeaderFrame(difference.head<2>(), course_rad);
  error.z() = difference.z();
  return error;
}

/// Distance from the slot, whatever the frame [m].
inline double TrueDistance(const experiment::VehicleTick& uav) { return TrueError(uav, 0).norm(); }

/// Flies a scenario and shows each control step.
inline experiment::Summary Fly(const config::Scenario& scenario,
                               const std::function<void(const experiment::Tick&)>& look,
                               const std::function<void(bus::Bus&)>& on_start = nullptr) {
  experiment::ExperimentOptions options;
  options.on_tick = look;
  options.on_start = on_start;
  return experiment::RunExperiment(scenario, options);
}

/// How near two UAVs are to one another's cylinder: below 1 they are inside.
inline double CylinderRatio(const VehicleState& a, const VehicleState& b, const ProximityLimits& limits) {
  const Eigen::Vector3d apart = Position(a) - Position(b);
  return std::max(apart.head<2>().norm() / limits.radius_m, std::abs(apart.z()) / limits.height_m);
}

}  // namespace skein::flights

#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/executor.h"
#include "core/vehicle.h"

namespace skein::controller {

/// All that the controller knows of one UAV.
struct VehicleView {
  int id = 0;
  std::string callsign;
  VehicleModel model;
  std::optional<VehicleState> state;  ///< last telemetry, none before the first
  bus::Utime state_utime = 0;         ///< of that telemetry
  bool fresh = false;                 ///< telemetry newer than at the last control step
  bool lost = false;                  ///< either direction of its data link, as LINK_STATUS tells

  /// Where it is thought to be at `utime`: as last heard, then straight on and level. Has a state.
  VehicleState At(bus::Utime utime) const;
};

/// By id, so that everything is done in the same order each time.
using FleetPicture = std::map<int, VehicleView>;

}  // namespace skein::controller

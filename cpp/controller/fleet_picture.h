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
  bus::Utime state_utime = 0;         ///< of that telemetry, never later than the tick that brought it
  bool fresh = false;                 ///< telemetry newer than at the last control step
  bool lost = false;                  ///< either direction of its data link, as LINK_STATUS tells

  /// Takes telemetry when it is newer than what is known. A stamp far off is taken when it is the third
  /// rising one in a row: then that UAV's clock was set.
  void Take(const VehicleState& heard, bus::Utime stamp, bus::Utime tick_utime);

  /// The fleet's clock was set: what is known is as of `tick_utime`, and any stamp is taken next.
  void TakeClock(bus::Utime tick_utime);

  /// Where it is thought to be at `utime`: as last heard, then straight on and level. Has a state.
  VehicleState At(bus::Utime utime) const;

 private:
  std::optional<bus::Utime> stamp_;  ///< of the telemetry taken last, by the UAV's own clock
  bus::Utime odd_stamp_ = 0;
  int odd_stamps_ = 0;
};

/// By id, so that everything is done in the same order each time.
using FleetPicture = std::map<int, VehicleView>;

}  // namespace skein::controller

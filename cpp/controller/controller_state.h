#pragma once

#include <optional>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bus/executor.h"

namespace skein::controller {

/// All that a controller needs to go on with one formation: the very messages that it repeats on the bus.
struct FormationState {
  formation_t formation;
  path_t path;
  formation_status_t status;
  std::optional<path_t> path_before_hold;  ///< when it holds: what Resume goes back to, and where
  double arc_before_hold_m = 0;
};

struct ControllerState {
  bus::Utime start_utime = 0;  ///< of the roster; another fleet's state is of no use
  std::vector<FormationState> formations;
  /// What was heard last of each UAV: one whose link is cut stays silent, and is avoided all the same.
  fleet_state_t heard{};
  std::vector<int> lost{};  ///< UAVs, by LINK_STATUS
};

/// As a bus::StateFile keeps it.
std::string Encode(const ControllerState& state);

/// None when the bytes hold none.
std::optional<ControllerState> DecodeControllerState(std::string_view bytes);

}  // namespace skein::controller

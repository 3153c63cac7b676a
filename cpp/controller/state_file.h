#pragma once

#include <filesystem>
#include <optional>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
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
};

/// Writes the state so that a crash leaves the old or the new one, never half of one. Throws
/// std::runtime_error with the file and why.
void WriteState(const std::filesystem::path& file, const ControllerState& state);

/// None when there is no such file or it is damaged.
std::optional<ControllerState> ReadState(const std::filesystem::path& file);

}  // namespace skein::controller

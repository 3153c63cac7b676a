#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <skein/event_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/slot_status_t.hpp>
#include <skein/vehicle_command_t.hpp>
#include <skein/vehicle_proximity_t.hpp>
#include <string_view>
#include <vector>

#include "bus/executor.h"
#include "core/vehicle.h"

namespace skein::experiment {

enum class Link { kUp, kLate, kLost };
/// "up", "late", "lost".
std::string_view Name(Link link);

/// One UAV at one control step: how it truly flies, and what the station knows and wants of it.
struct VehicleTick {
  int id = 0;
  VehicleState truth;
  bool payload_on = false;
  bool uplink_cut = false;    ///< in truth
  bool downlink_cut = false;  ///< in truth

  std::optional<bus::Utime> heard_utime;     ///< of its telemetry in this tick's FLEET_STATE
  std::optional<vehicle_command_t> command;  ///< sent in answer to this tick
  int formation_id = 0;                      ///< 0: none
  std::optional<slot_status_t> slot;         ///< of this tick's FORMATION_STATUS
  Link downlink = Link::kUp;                 ///< as the monitor sees it
  Link uplink = Link::kUp;
  std::optional<vehicle_proximity_t> proximity;  ///< of the last sweep

  /// The worse of both directions.
  Link link() const { return std::max(downlink, uplink); }
  int level() const { return proximity ? proximity->level : 0; }
};

/// Everything about one control step, after all nodes have done with it.
struct Tick {
  std::int64_t number = 0;
  bus::Utime utime = 0;
  double t_s = 0;                     ///< since the start of the scenario
  std::vector<VehicleTick> vehicles;  ///< in the order of the scenario
  std::map<int, formation_status_t> formations;
  std::vector<event_t> events;  ///< since the step before
};

}  // namespace skein::experiment

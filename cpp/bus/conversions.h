#pragma once

#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <skein/slot_t.hpp>
#include <skein/vehicle_info_t.hpp>
#include <skein/vehicle_state_t.hpp>
#include <skein/waypoint_t.hpp>
#include <string>
#include <vector>

#include "core/formation.h"
#include "core/path.h"
#include "core/proximity.h"
#include "core/vehicle.h"

/// Messages to core structs and back. Messages that come from a Bus are valid; ToPath alone can still refuse
/// one.
namespace skein::bus {

VehicleState ToVehicleState(const vehicle_state_t& message);
/// Fills in the motion; identity, time and what was obeyed are the caller's.
vehicle_state_t ToMessage(const VehicleState& state);

VehicleModel ToVehicleModel(const vehicle_info_t& message);
vehicle_info_t ToMessage(int id, const std::string& callsign, const VehicleModel& model, bool has_payload);

Slot ToSlot(const slot_t& message);
slot_t ToMessage(const Slot& slot);
std::vector<Slot> ToSlots(const formation_t& message);
void SetSlots(formation_t& message, const std::vector<Slot>& slots);

/// Thresholds between the members; those that the message does not carry keep their defaults.
ProximityLimits ToProximityLimits(const formation_t& message);
void SetProximityLimits(formation_t& message, const ProximityLimits& limits);

Waypoint ToWaypoint(const waypoint_t& message);
waypoint_t ToMessage(const Waypoint& waypoint);
template <typename Message>  // path_t or path_command_t
std::vector<Waypoint> ToWaypoints(const Message& message) {
  std::vector<Waypoint> waypoints;
  for (const waypoint_t& waypoint : message.waypoints) waypoints.push_back(ToWaypoint(waypoint));
  return waypoints;
}

template <typename Message>
void SetWaypoints(Message& message, const std::vector<Waypoint>& waypoints) {
  message.waypoints.clear();
  for (const Waypoint& waypoint : waypoints) message.waypoints.push_back(ToMessage(waypoint));
  message.num_waypoints = static_cast<int>(message.waypoints.size());
}

/// The path as the leader flies it. Throws what the constructor of Path throws.
Path ToPath(const path_t& message);
/// Fills in the geometry; utime, formation_id, path_revision and waypoints are the caller's.
path_t ToMessage(const Path& path);

}  // namespace skein::bus

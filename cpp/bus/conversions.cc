#include "bus/conversions.h"

#include <optional>
#include <utility>

namespace skein::bus {

VehicleState ToVehicleState(const vehicle_state_t& message) {
  return {message.east_m,    message.north_m,    message.up_m,
          message.speed_m_s, message.course_rad, message.climb_rad};
}

vehicle_state_t ToMessage(const VehicleState& state) {
  vehicle_state_t message;
  message.east_m = state.east_m;
  message.north_m = state.north_m;
  message.up_m = state.up_m;
  message.speed_m_s = state.speed_m_s;
  message.course_rad = state.course_rad;
  message.climb_rad = state.climb_rad;
  return message;
}

VehicleModel ToVehicleModel(const vehicle_info_t& message) {
  VehicleModel model;
  model.name = message.model;
  model.gains = {message.k_speed_per_s, message.k_course_per_s, message.k_climb_per_s};
  model.envelope = {message.min_speed_m_s,         message.max_speed_m_s, message.max_acceleration_m_s2,
                    message.max_course_rate_rad_s, message.max_climb_rad, message.max_climb_rate_rad_s};
  return model;
}

vehicle_info_t ToMessage(int id, const std::string& callsign, const VehicleModel& model, bool has_payload) {
  vehicle_info_t message;
  message.id = id;
  message.callsign = callsign;
  message.model = model.name;
  message.k_speed_per_s = model.gains.speed_per_s;
  message.k_course_per_s = model.gains.course_per_s;
  message.k_climb_per_s = model.gains.climb_per_s;
  message.min_speed_m_s = model.envelope.min_speed_m_s;
  message.max_speed_m_s = model.envelope.max_speed_m_s;
  message.max_acceleration_m_s2 = model.envelope.max_acceleration_m_s2;
  message.max_course_rate_rad_s = model.envelope.max_course_rate_rad_s;
  message.max_climb_rad = model.envelope.max_climb_rad;
  message.max_climb_rate_rad_s = model.envelope.max_climb_rate_rad_s;
  message.has_payload = has_payload;
  return message;
}

Slot ToSlot(const slot_t& message) {
  return {message.vehicle_id, {message.forward_m, message.left_m, message.up_m}};
}

slot_t ToMessage(const Slot& slot) {
  slot_t message;
  message.vehicle_id = slot.vehicle_id;
  message.forward_m = slot.offset.forward_m;
  message.left_m = slot.offset.left_m;
  message.up_m = slot.offset.up_m;
  return message;
}

std::vector<Slot> ToSlots(const formation_t& message) {
  std::vector<Slot> slots;
  for (const slot_t& slot : message.slots) slots.push_back(ToSlot(slot));
  return slots;
}

void SetSlots(formation_t& message, const std::vector<Slot>& slots) {
  message.slots.clear();
  for (const Slot& slot : slots) message.slots.push_back(ToMessage(slot));
  message.num_slots = static_cast<int>(message.slots.size());
}

ProximityLimits ToProximityLimits(const formation_t& message) {
  ProximityLimits limits;
  limits.radius_m = message.radius_m;
  limits.height_m = message.height_m;
  limits.d_mod_m = message.d_mod_m;
  limits.advisory_tau_s = message.advisory_tau_s;
  limits.caution_tau_s = message.caution_tau_s;
  return limits;
}

void SetProximityLimits(formation_t& message, const ProximityLimits& limits) {
  message.radius_m = limits.radius_m;
  message.height_m = limits.height_m;
  message.d_mod_m = limits.d_mod_m;
  message.advisory_tau_s = limits.advisory_tau_s;
  message.caution_tau_s = limits.caution_tau_s;
}

Waypoint ToWaypoint(const waypoint_t& message) {
  return {message.east_m, message.north_m, message.up_m, message.speed_m_s, message.turn_radius_m};
}

waypoint_t ToMessage(const Waypoint& waypoint) {
  waypoint_t message;
  message.east_m = waypoint.east_m;
  message.north_m = waypoint.north_m;
  message.up_m = waypoint.up_m;
  message.speed_m_s = waypoint.speed_m_s;
  message.turn_radius_m = waypoint.turn_radius_m;
  return message;
}

Path ToPath(const path_t& message) {
  std::vector<PathPiece> pieces;
  for (const path_piece_t& piece : message.pieces) {
    pieces.push_back({piece.length_m,
                      {piece.start_east_m, piece.start_north_m},
                      piece.start_course_rad,
                      piece.start_curvature_per_m,
                      piece.end_curvature_per_m});
  }
  std::vector<ProfileKnot> profile;
  for (const path_profile_t& knot : message.profile) {
    profile.push_back({knot.arc_m, knot.altitude_m, knot.planned_speed_m_s, knot.up_slope,
                       knot.up_slope_rate_per_m, knot.speed_slope_per_s, knot.speed_slope_rate_per_m_s});
  }
  const bool closed = message.loop_start_m != -1;
  return {message.start_arc_m, std::move(pieces), std::move(profile),
          closed ? std::optional(message.loop_start_m) : std::nullopt};
}

path_t ToMessage(const Path& path) {
  path_t message;
  message.start_arc_m = path.start_arc_m();
  message.loop_start_m = path.loop_start_m().value_or(-1);
  for (const PathPiece& piece : path.pieces()) {
    path_piece_t item;
    item.length_m = piece.length_m;
    item.start_east_m = piece.start.x();
    item.start_north_m = piece.start.y();
    item.start_course_rad = piece.start_course_rad;
    item.start_curvature_per_m = piece.start_curvature_per_m;
    item.end_curvature_per_m = piece.end_curvature_per_m;
    message.pieces.push_back(item);
  }
  message.num_pieces = static_cast<int>(message.pieces.size());
  for (const ProfileKnot& knot : path.profile()) {
    path_profile_t item;
    item.arc_m = knot.arc_m;
    item.altitude_m = knot.up_m;
    item.planned_speed_m_s = knot.speed_m_s;
    item.up_slope = knot.up_slope;
    item.up_slope_rate_per_m = knot.up_slope_rate_per_m;
    item.speed_slope_per_s = knot.speed_slope_per_s;
    item.speed_slope_rate_per_m_s = knot.speed_slope_rate_per_m_s;
    message.profile.push_back(item);
  }
  message.num_profile = static_cast<int>(message.profile.size());
  return message;
}

}  // namespace skein::bus

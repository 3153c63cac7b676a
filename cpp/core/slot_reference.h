#pragma once

#include <Eigen/Core>

#include "core/altitude_offset.h"
#include "core/formation.h"
#include "core/path.h"
#include "core/vehicle.h"

namespace skein {

/// Where a slot is at one instant and how it moves: position, velocity and acceleration, in path terms.
struct SlotReference {
  Eigen::Vector3d position{0, 0, 0};  ///< local ENU [m]
  double course_rad = 0;              ///< theta of the path beside the slot, unwrapped
  double course_rate_rad_s = 0;
  double speed_m_s = 0;  ///< horizontal, along theta
  double acceleration_m_s2 = 0;
  double climb_m_s = 0;  ///< vertical speed
  double climb_acceleration_m_s2 = 0;
};

/// A slot in path coordinates: at arc length leader_arc_m + forward, left of the path there. A rigid slot
/// behind the leader's nose is the special case of a straight path. With curvature kappa at the slot and the
/// leader's speed v_L, the slot's speed is v_L (1 - kappa left), its rate v_L' (1 - kappa left) - v_L^2 left
/// dkappa/ds.
/// @param offset is added to the planned altitude; it is the same for every slot at the same instant.
SlotReference SlotOnPath(const Path& path, double leader_arc_m, const SlotOffset& slot,
                         const AltitudeOffset& offset);
/// The same for one slot after the other. @param leader is path.At(leader_arc_m).
SlotReference SlotOnPath(const Path& path, const PathPoint& leader, const SlotOffset& slot,
                         const AltitudeOffset& offset);

/// The virtual leader as a vehicle state, altitude offset included (climb angle from both).
VehicleState LeaderState(const Path& path, double leader_arc_m, const AltitudeOffset& offset);

/// Slot minus UAV in the slot's own frame (forward along course_rad, left, up) [m].
Eigen::Vector3d SlotError(const SlotReference& slot, const Eigen::Vector3d& position);

}  // namespace skein

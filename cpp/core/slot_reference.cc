#include "core/slot_reference.h"

#include <cmath>

#include "core/frames.h"

namespace skein {

SlotReference SlotOnPath(const Path& path, double leader_arc_m, const SlotOffset& slot,
                         const AltitudeOffset& offset) {
  return SlotOnPath(path, path.At(leader_arc_m), slot, offset);
}

SlotReference SlotOnPath(const Path& path, const PathPoint& leader, const SlotOffset& slot,
                         const AltitudeOffset& offset) {
  const PathPoint beside = path.At(leader.arc_m + slot.forward_m);
  const double leader_speed = leader.speed_m_s;
  const double leader_acceleration = leader_speed * leader.speed_slope_per_s;
  const double stretch = 1 - beside.curvature_per_m * slot.left_m;

  SlotReference reference;
  const Eigen::Vector2d left(-std::sin(beside.course_rad), std::cos(beside.course_rad));
  reference.position.head<2>() = beside.position + slot.left_m * left;
  reference.position.z() = beside.up_m + slot.up_m + offset.height_m;
  reference.course_rad = beside.course_rad;
  reference.course_rate_rad_s = leader_speed * beside.curvature_per_m;
  reference.speed_m_s = leader_speed * stretch;
  reference.acceleration_m_s2 = leader_acceleration * stretch -
                                leader_speed * leader_speed * slot.left_m * beside.curvature_slope_per_m2;
  reference.climb_m_s = leader_speed * beside.up_slope + offset.rate_m_s;
  reference.climb_acceleration_m_s2 = leader_acceleration * beside.up_slope +
                                      leader_speed * leader_speed * beside.up_slope_rate_per_m +
                                      offset.acceleration_m_s2;
  return reference;
}

VehicleState LeaderState(const Path& path, double leader_arc_m, const AltitudeOffset& offset) {
  const PathPoint point = path.At(leader_arc_m);
  VehicleState state;
  state.east_m = point.position.x();
  state.north_m = point.position.y();
  state.up_m = point.up_m + offset.height_m;
  const double climb_m_s = point.speed_m_s * point.up_slope + offset.rate_m_s;
  state.speed_m_s = std::hypot(point.speed_m_s, climb_m_s);
  state.course_rad = point.course_rad;
  state.climb_rad = std::atan2(climb_m_s, point.speed_m_s);
  return state;
}

Eigen::Vector3d SlotError(const SlotReference& slot, const Eigen::Vector3d& position) {
  const Eigen::Vector3d difference = slot.position - position;
  Eigen::Vector3d error;
  error.head<2>() = ToLeaderFrame(difference.head<2>(), slot.course_rad);
  error.z() = difference.z();
  return error;
}

}  // namespace skein

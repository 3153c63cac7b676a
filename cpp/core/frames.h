#pragma once

#include <Eigen/Core>

#include "core/vehicle.h"

namespace skein {

/// Wraps an angle to (-pi, pi].
double WrapAngle(double angle_rad);

/// The angle equal to `angle_rad` modulo 2 pi that is nearest to `reference_rad`.
double UnwrapNear(double angle_rad, double reference_rad);

/// Horizontal ENU vector (east, north) -> (forward, left) of a leader on course_rad. Eq. (6) of [1], axes put
/// right.
Eigen::Vector2d ToLeaderFrame(const Eigen::Vector2d& east_north, double course_rad);

/// The inverse of ToLeaderFrame.
Eigen::Vector2d FromLeaderFrame(const Eigen::Vector2d& forward_left, double course_rad);

Eigen::Vector3d Position(const VehicleState& state);

/// ENU velocity [m/s]; eq. (2) of [1].
Eigen::Vector3d Velocity(const VehicleState& state);

/// Compass degrees (0 north, 90 east), 0 .. 360, and back to radians counter-clockwise from east, -pi .. pi.
double CompassDegrees(double course_rad);
double CourseFromCompass(double compass_deg);

}  // namespace skein

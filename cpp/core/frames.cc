#include "core/frames.h"

#include <cmath>
#include <numbers>

namespace skein {

using std::numbers::pi;

double WrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

double UnwrapNear(double angle_rad, double reference_rad) {
  return reference_rad + WrapAngle(angle_rad - reference_rad);
}

Eigen::Vector2d ToLeaderFrame(const Eigen::Vector2d& east_north, double course_rad) {
  const double c = std::cos(course_rad);
  const double s = std::sin(course_rad);
  return {east_north.x() * c + east_north.y() * s, -east_north.x() * s + east_north.y() * c};
}

Eigen::Vector2d FromLeaderFrame(const Eigen::Vector2d& forward_left, double course_rad) {
  return ToLeaderFrame(forward_left, -course_rad);
}

Eigen::Vector3d Position(const VehicleState& state) { return {state.east_m, state.north_m, state.up_m}; }

Eigen::Vector3d Velocity(const VehicleState& state) {
  const double horizontal = state.speed_m_s * std::cos(state.climb_rad);
  return {horizontal * std::cos(state.course_rad), horizontal * std::sin(state.course_rad),
          state.speed_m_s * std::sin(state.climb_rad)};
}

double CompassDegrees(double course_rad) {
  const double degrees = std::remainder(90 - course_rad * 180 / pi, 360);
  const double positive = degrees < 0 ? degrees + 360 : degrees;
  return positive < 360 ? positive : 0;  // a tiny negative angle rounds up to 360
}

double CourseFromCompass(double compass_deg) { return WrapAngle((90 - compass_deg) * pi / 180); }

}  // namespace skein

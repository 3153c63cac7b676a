#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/path.h"

namespace skein {

/// Checks by finite differences, on a fine grid, that what At() tells is one smooth curve: position' is the
/// direction of the course, course' the curvature, curvature and slopes have no jump, altitude' and speed'
/// are the slopes.
inline void ExpectSmooth(const Path& path, double from_m, double to_m, double most_slope_per_m2 = 1e-3,
                         double step_m = 1) {
  const double chord_error = 2e-5 + 2e-6 * step_m * step_m;
  PathPoint last = path.At(from_m);
  for (double arc = from_m + step_m; arc <= to_m; arc += step_m) {
    const PathPoint point = path.At(arc);
    const PathPoint middle = path.At(arc - 0.5 * step_m);
    const Eigen::Vector2d direction = (point.position - last.position) / step_m;
    ASSERT_NEAR(direction.x(), std::cos(middle.course_rad), chord_error) << "at arc length " << arc;
    ASSERT_NEAR(direction.y(), std::sin(middle.course_rad), chord_error) << "at arc length " << arc;
    ASSERT_NEAR((point.course_rad - last.course_rad) / step_m, middle.curvature_per_m,
                most_slope_per_m2 * step_m)
        << "at arc length " << arc;
    ASSERT_NEAR(point.curvature_per_m, last.curvature_per_m, most_slope_per_m2 * step_m)
        << "at arc length " << arc;
    ASSERT_NEAR((point.up_m - last.up_m) / step_m, middle.up_slope, 1e-4 * step_m) << "at arc length " << arc;
    ASSERT_NEAR(point.up_slope, last.up_slope, 0.01 * step_m) << "at arc length " << arc;
    ASSERT_NEAR((point.speed_m_s - last.speed_m_s) / step_m, middle.speed_slope_per_s, 1e-4 * step_m)
        << "at arc length " << arc;
    ASSERT_NEAR(point.speed_slope_per_s, last.speed_slope_per_s, 0.01 * step_m) << "at arc length " << arc;
    last = point;
  }
}

/// Flies slots along the path by finite differences of their positions, without any formula of the planner,
/// and expects them within the limits times `slack`. The leader flies from from_m to to_m; a slot is at its
/// arc length plus the slot's forward.
inline void ExpectSlotsWithin(const Path& path, const PathLimits& limits, double from_m, double to_m,
                              double slack = 1.03, double step_s = 0.5) {
  const double forwards[] = {limits.foremost_m, limits.hindmost_m};
  const double lefts[] = {limits.most_left_m, -limits.most_right_m};
  const auto place = [&](double leader_m, double forward_m, double left_m) {
    const PathPoint point = path.At(leader_m + forward_m);
    return Eigen::Vector3d(point.position.x() - left_m * std::sin(point.course_rad),
                           point.position.y() + left_m * std::cos(point.course_rad), point.up_m);
  };
  const auto later = [&](double arc_m, double time_s) {
    const double half = arc_m + 0.5 * time_s * path.At(arc_m).speed_m_s;
    return arc_m + time_s * path.At(half).speed_m_s;
  };
  for (double arc = from_m; arc < to_m; arc = later(arc, step_s)) {
    const double arcs[] = {later(arc, -step_s), arc, later(arc, step_s)};
    for (const double forward : forwards) {
      for (const double left : lefts) {
        const Eigen::Vector3d a = place(arcs[0], forward, left), b = place(arcs[1], forward, left),
                              c = place(arcs[2], forward, left);
        const Eigen::Vector3d v0 = (b - a) / step_s, v1 = (c - b) / step_s;
        const double h0 = v0.head<2>().norm(), h1 = v1.head<2>().norm();
        ASSERT_GE(h1 * slack, limits.min_speed_m_s)
            << "leader at " << arc << ", slot " << forward << ", " << left;
        ASSERT_LE(h1, limits.max_speed_m_s * slack)
            << "leader at " << arc << ", slot " << forward << ", " << left;
        const double turn = std::remainder(std::atan2(v1.y(), v1.x()) - std::atan2(v0.y(), v0.x()), 2 * M_PI);
        ASSERT_LE(std::abs(turn) / step_s, limits.max_course_rate_rad_s * slack + 1e-4)
            << "leader at " << arc << ", slot " << forward << ", " << left;
        ASSERT_LE(std::abs(v1.norm() - v0.norm()) / step_s, limits.max_acceleration_m_s2 * slack + 0.01)
            << "leader at " << arc << ", slot " << forward << ", " << left;
        const double climb0 = std::atan2(v0.z(), h0), climb1 = std::atan2(v1.z(), h1);
        ASSERT_LE(std::abs(climb1), limits.max_climb_rad * slack)
            << "leader at " << arc << ", slot " << forward << ", " << left;
        ASSERT_LE(std::abs(climb1 - climb0) / step_s, limits.max_climb_rate_rad_s * slack + 1e-4)
            << "leader at " << arc << ", slot " << forward << ", " << left;
      }
    }
  }
}

}  // namespace skein

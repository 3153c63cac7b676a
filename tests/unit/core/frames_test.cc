#include "core/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

using std::numbers::pi;

TEST(Frames, WrapsToMinusPiExclusiveToPi) {
  EXPECT_EQ(WrapAngle(0), 0);
  EXPECT_DOUBLE_EQ(WrapAngle(pi), pi);
  EXPECT_DOUBLE_EQ(WrapAngle(-pi), pi);
  EXPECT_NEAR(WrapAngle(pi + 0.1), -pi + 0.1, 1e-12);
  EXPECT_NEAR(WrapAngle(-pi - 0.1), pi - 0.1, 1e-12);
  EXPECT_NEAR(WrapAngle(7 * pi), pi, 1e-12);
  EXPECT_NEAR(WrapAngle(100 * pi + 1), 1, 1e-12);
}

TEST(Frames, UnwrapsToTheNearestTurn) {
  EXPECT_NEAR(UnwrapNear(-pi + 0.1, pi - 0.1), pi + 0.1, 1e-12);
  EXPECT_NEAR(UnwrapNear(0.2, 6 * pi), 6 * pi + 0.2, 1e-12);
  EXPECT_NEAR(UnwrapNear(1, 1), 1, 1e-12);
}

TEST(Frames, LeaderFlyingNorthHasForwardNorthAndLeftWest) {
  const Eigen::Vector2d north = ToLeaderFrame({0, 5}, pi / 2);
  EXPECT_NEAR(north.x(), 5, 1e-12);
  EXPECT_NEAR(north.y(), 0, 1e-12);
  const Eigen::Vector2d west = ToLeaderFrame({-3, 0}, pi / 2);
  EXPECT_NEAR(west.x(), 0, 1e-12);
  EXPECT_NEAR(west.y(), 3, 1e-12);
}

TEST(Frames, LeaderFlyingEastHasForwardEastAndLeftNorth) {
  EXPECT_NEAR(ToLeaderFrame({2, 1}, 0).x(), 2, 1e-12);
  EXPECT_NEAR(ToLeaderFrame({2, 1}, 0).y(), 1, 1e-12);
}

TEST(Frames, GoesThereAndBack) {
  for (const double course : {-3.0, -pi / 2, 0.0, 0.7, 2.0, 3 * pi + 0.1}) {
    const Eigen::Vector2d vector{123, -45};
    EXPECT_TRUE(FromLeaderFrame(ToLeaderFrame(vector, course), course).isApprox(vector, 1e-12));
  }
}

TEST(Frames, VelocityOfAClimbingVehicle) {
  // 50 m/s on course 90 degrees, climbing 30 degrees: 43.301 north, 25 up.
  const Eigen::Vector3d velocity = Velocity({.speed_m_s = 50, .course_rad = pi / 2, .climb_rad = pi / 6});
  EXPECT_NEAR(velocity.x(), 0, 1e-12);
  EXPECT_NEAR(velocity.y(), 43.30127, 1e-5);
  EXPECT_NEAR(velocity.z(), 25, 1e-12);
}

TEST(Frames, CompassIsClockwiseFromNorth) {
  EXPECT_NEAR(CompassDegrees(pi / 2), 0, 1e-12);
  EXPECT_NEAR(CompassDegrees(0), 90, 1e-12);
  EXPECT_NEAR(CompassDegrees(-pi / 2), 180, 1e-12);
  EXPECT_NEAR(CompassDegrees(pi), 270, 1e-12);
  EXPECT_NEAR(CompassDegrees(-pi), 270, 1e-12);
  EXPECT_NEAR(CompassDegrees(20 * pi), 90, 1e-9);
  EXPECT_LT(CompassDegrees(std::nextafter(pi / 2, 4.0)), 360);
  EXPECT_NEAR(CourseFromCompass(0), pi / 2, 1e-12);
  EXPECT_NEAR(CourseFromCompass(270), pi, 1e-12);
  EXPECT_NEAR(CourseFromCompass(359), pi / 2 + pi / 180, 1e-12);
}

}  // namespace
}  // namespace skein

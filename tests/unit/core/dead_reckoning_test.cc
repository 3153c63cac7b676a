#include "core/dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace skein {
namespace {

using std::numbers::pi;

VehicleState State(double speed_m_s, double course_rad, double climb_rad) {
  VehicleState state;
  state.east_m = 100;
  state.north_m = 200;
  state.up_m = 1000;
  state.speed_m_s = speed_m_s;
  state.course_rad = course_rad;
  state.climb_rad = climb_rad;
  return state;
}

TEST(DeadReckoning, GoesStraightOn) {
  const Estimate north = DeadReckon(State(50, pi / 2, 0), 10, 10);
  EXPECT_NEAR(north.position.x(), 100, 1e-9);
  EXPECT_NEAR(north.position.y(), 700, 1e-9);
  EXPECT_NEAR(north.position.z(), 1000, 1e-9);
  EXPECT_NEAR(north.velocity.y(), 50, 1e-9);
}

TEST(DeadReckoning, ClimbsForASecondThenFliesLevel) {
  // 50 m/s at asin(0.6): 40 m/s over ground, 30 m/s up.
  const VehicleState climbing = State(50, 0, std::asin(0.6));
  const Estimate delayed = DeadReckon(climbing, 0.2, 0);
  EXPECT_NEAR(delayed.position.x(), 108, 1e-9);
  EXPECT_NEAR(delayed.position.z(), 1006, 1e-9);
  EXPECT_NEAR(delayed.velocity.z(), 30, 1e-9);
  const Estimate lost = DeadReckon(climbing, 20, 20);
  EXPECT_NEAR(lost.position.x(), 900, 1e-9);
  EXPECT_NEAR(lost.position.z(), 1030, 1e-9);
  EXPECT_EQ(lost.velocity.z(), 0);
}

TEST(DeadReckoning, UncertaintyGrowsWithSilenceUpToALimit) {
  EXPECT_EQ(DeadReckon(State(50, 0, 0), 0.2, 0).horizontal_uncertainty_m, 0);
  EXPECT_EQ(DeadReckon(State(50, 0, 0), 0.2, 0).vertical_uncertainty_m, 0);
  EXPECT_DOUBLE_EQ(DeadReckon(State(50, 0, 0), 30, 30).horizontal_uncertainty_m, 60);
  EXPECT_DOUBLE_EQ(DeadReckon(State(50, 0, 0), 30, 30).vertical_uncertainty_m, 30);
  EXPECT_DOUBLE_EQ(DeadReckon(State(50, 0, 0), 1e4, 1e4).horizontal_uncertainty_m, 300);
  EXPECT_DOUBLE_EQ(DeadReckon(State(50, 0, 0), 1e4, 1e4).vertical_uncertainty_m, 50);
}

TEST(DeadReckoning, AtNoAgeIsTheState) {
  const Estimate now = DeadReckon(State(50, 1, 0.1), 0, 0);
  EXPECT_EQ(now.position, Eigen::Vector3d(100, 200, 1000));
}

TEST(UncertaintyGrowth, RefusesWhatMakesNoSense) {
  EXPECT_NO_THROW(Check(UncertaintyGrowth{}));
  UncertaintyGrowth growth;
  growth.most_vertical_m = -1;
  EXPECT_THROW(Check(growth), std::invalid_argument);
}

}  // namespace
}  // namespace skein

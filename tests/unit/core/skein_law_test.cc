#include "core/skein_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/frames.h"
#include "unit/core/time_steps.h"

namespace skein {
namespace {

using std::numbers::pi;

SlotReference NorthboundSlot(double time_s, double speed_m_s = 50) {
  SlotReference slot;
  slot.position = {0, 4000 + speed_m_s * time_s, 1000};
  slot.course_rad = pi / 2;
  slot.speed_m_s = speed_m_s;
  return slot;
}

/// What an approach to NorthboundSlot was like.
struct Approach {
  Eigen::Vector3d settled_s{0, 0, 0};    ///< last time that the error was over 10 m
  Eigen::Vector3d overshoot_m{0, 0, 0};  ///< on the other side of the slot from where it came
  double least_speed_m_s = 1e9;
  double greatest_speed_m_s = 0;
  VehicleState end;
  double end_error_m = 0;
};

Approach Fly(VehicleState uav, double duration_s, const VehicleModel& model = {}) {
  SkeinLaw law;
  Approach approach;
  const Eigen::Vector3d side = SlotError(NorthboundSlot(0), Position(uav)).cwiseSign();
  for (double time = 0; time < duration_s; time += kStep) {
    const SlotReference slot = NorthboundSlot(time);
    const Eigen::Vector3d error = SlotError(slot, Position(uav));
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(error[axis]) > 10) approach.settled_s[axis] = time;
      approach.overshoot_m[axis] = std::max(approach.overshoot_m[axis], -side[axis] * error[axis]);
    }
    approach.least_speed_m_s = std::min(approach.least_speed_m_s, uav.speed_m_s);
    approach.greatest_speed_m_s = std::max(approach.greatest_speed_m_s, uav.speed_m_s);
    approach.end_error_m = error.norm();
    uav = Step(uav, law.Control(slot, uav, model, kStep).input, model, kStep);
  }
  approach.end = uav;
  return approach;
}

TEST(SkeinLaw, AssemblesFromThePapersStartWithinAMinute) {
  const Approach approach = Fly({1000, 3000, 800, 60, pi / 2, 0}, 120);
  EXPECT_LE(approach.settled_s.maxCoeff(), 60);
  EXPECT_LE(approach.overshoot_m.maxCoeff(), 5);
  EXPECT_GE(approach.least_speed_m_s, 30);
  EXPECT_LE(approach.greatest_speed_m_s, 90);
}

TEST(SkeinLaw, ComesBackFromAheadAboveAndTheWrongWayRound) {
  for (const double course : {-pi / 2, 0.0, pi, 2 * pi + pi / 2, -7.0}) {
    const Approach approach = Fly({-300, 5500, 1150, 70, course, 0.1}, 300);
    EXPECT_LE(approach.end_error_m, 3) << "started on course " << course;
    EXPECT_GE(approach.least_speed_m_s, 30);
    EXPECT_LE(approach.greatest_speed_m_s, 90);
  }
}

TEST(SkeinLaw, AsksForNothingInItsSlot) {
  const VehicleModel model;
  const VehicleState uav{0, 4000, 1000, 50, pi / 2, 0};
  const LawOutput output = SkeinLaw().Control(NorthboundSlot(0), uav, model, kStep);
  EXPECT_NEAR(output.input.speed_m_s, 50, 1e-9);
  EXPECT_NEAR(output.input.course_rad, pi / 2, 1e-9);
  EXPECT_NEAR(output.input.climb_rad, 0, 1e-9);
}

TEST(SkeinLaw, InvertsTheAutopilotForATurningSlot) {
  // A slot on a circle to the left of 1000 m radius at 50 m/s turns at 0.05 rad/s; eq. (1) needs phi + 0.05 /
  // 0.1 for that.
  SlotReference slot = NorthboundSlot(0);
  slot.course_rate_rad_s = 0.05;
  slot.acceleration_m_s2 = 0.5;
  const VehicleState uav{0, 4000, 1000, 50, pi / 2, 0};
  const LawOutput output = SkeinLaw().Control(slot, uav, VehicleModel(), kStep);
  EXPECT_NEAR(output.input.course_rad, pi / 2 + 0.5, 1e-9);
  EXPECT_NEAR(output.input.speed_m_s, 50 + 0.5 / 0.01, 1e-9);
}

TEST(SkeinLaw, KeepsItsSetpointsWithinTheEnvelope) {
  const VehicleModel model;
  const VehicleState uav{9000, -20000, 0, 31, -pi / 2, -0.3};
  const LawOutput output = SkeinLaw().Control(NorthboundSlot(0), uav, model, kStep);
  EXPECT_LE(output.setpoint.speed_m_s, 90);
  EXPECT_LE(std::abs(output.setpoint.climb_rad), 0.35);
  EXPECT_LE(std::abs(output.rates.acceleration_m_s2), 2);
  EXPECT_LE(std::abs(output.rates.course_rate_rad_s), 0.2);
  EXPECT_LE(std::abs(output.rates.climb_rate_rad_s), 0.2);
}

TEST(SkeinLaw, TurnsTheShortWayAcrossPlusMinusPi) {
  SlotReference slot = NorthboundSlot(0);
  slot.course_rad = -pi + 0.1;
  const VehicleState uav{0, 4000, 1000, 50, pi - 0.1, 0};
  const LawOutput output = SkeinLaw().Control(slot, uav, VehicleModel(), kStep);
  EXPECT_GT(output.input.course_rad, uav.course_rad);
  EXPECT_LT(output.setpoint.course_rad - uav.course_rad, 0.5);
}

TEST(SkeinLaw, RefusesGainsThatMakeNoSense) {
  EXPECT_THROW(SkeinLawParametersFrom({{"position_per_s", -1}}), std::invalid_argument);
  EXPECT_THROW(SkeinLawParametersFrom({{"position_per_s", std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(SkeinLawParametersFrom({{"k_ex", 1}}), std::invalid_argument);
  EXPECT_DOUBLE_EQ(SkeinLawParametersFrom({{"speed_per_s", 0.4}}).speed_per_s, 0.4);
}

TEST(HoldAltitude, KeepsCourseSpeedAndAltitude) {
  const VehicleModel model;
  const VehicleState held{0, 0, 1000, 55, 3, 0};
  VehicleState uav = held;
  uav.climb_rad = 0.2;  // caught in a climb
  double highest = 0;
  for (double time = 0; time < 300; time += kStep) {
    uav = Step(uav, HoldAltitude(held, uav, model).input, model, kStep);
    highest = std::max(highest, uav.up_m);
  }
  EXPECT_NEAR(uav.up_m, 1000, 1);
  EXPECT_NEAR(uav.speed_m_s, 55, 1e-6);
  EXPECT_NEAR(uav.course_rad, 3, 1e-9);
  EXPECT_LT(highest, 1100);
}

}  // namespace
}  // namespace skein

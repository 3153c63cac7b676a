#include "core/paper_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/frames.h"
#include "unit/core/time_steps.h"

namespace skein {
namespace {

using std::numbers::pi;

const SlotOffset kSlot{-1000, 0, 0};
const VehicleModel kModel;

/// The leader and the wing plane of section III.D of [1]; the leader flies straight on.
struct PaperTest {
  VehicleState leader{.north_m = 5000, .up_m = 1000, .speed_m_s = 50, .course_rad = pi / 2};
  VehicleState wing{.east_m = 1000, .north_m = 3000, .up_m = 800, .speed_m_s = 60, .course_rad = pi / 2};
  PaperLaw law;

  StateError Error() const { return ErrorInLeaderFrame(leader, kSlot, wing); }
  AutopilotInput Control() { return law.Update(leader, kSlot, wing, kModel, kStep); }
  void Fly(const AutopilotInput& input) {
    wing = Step(wing, input, kModel, kStep);
    const Eigen::Vector3d velocity = Velocity(leader);
    leader.east_m += velocity.x() * kStep;
    leader.north_m += velocity.y() * kStep;
    leader.up_m += velocity.z() * kStep;
  }
};

TEST(PaperLaw, FirstCommandOfThePapersTest) {
  // e_x = 1.5 * 50 + 10 * (50 - 60) = -25, e_y = 0.1 * 50 = 5, e_z = 0.04 * 50 = 2; proportional parts only.
  PaperTest test;
  const AutopilotInput input = test.Control();
  EXPECT_NEAR(input.speed_m_s, 3 * -25, 1e-9);
  EXPECT_NEAR(input.course_rad, pi / 2 + 5 * 5, 1e-9);
  EXPECT_NEAR(input.climb_rad, 5 * 2, 1e-9);
}

TEST(PaperLaw, AssemblesAsInFigure6) {
  PaperTest test;
  double forward_s = 0, left_s = 0, up_s = 0, speed_s = 0, fastest_m_s = 0, slowest_m_s = 1000;
  for (int i = 0; i < 300 * 20; ++i) {
    const StateError error = test.Error();
    const double t = i * kStep;
    if (std::abs(error.forward_m) > 10) forward_s = t;
    if (std::abs(error.left_m) > 10) left_s = t;
    if (std::abs(error.up_m) > 10) up_s = t;
    if (std::abs(error.speed_m_s) > 1) speed_s = t;
    fastest_m_s = std::max(fastest_m_s, test.wing.speed_m_s);
    slowest_m_s = std::min(slowest_m_s, test.wing.speed_m_s);
    test.Fly(test.Control());
  }
  // Promised to users.
  EXPECT_LE(forward_s, 190);
  EXPECT_LE(left_s, 50);
  EXPECT_LE(up_s, 50);
  EXPECT_LE(speed_s, 195);
  EXPECT_LE(fastest_m_s, 60.5);
  // An independent simulation (other language, other integrator) found 178.1, 39.4, 11.8 and 182.7 s, 49.6
  // m/s.
  EXPECT_NEAR(forward_s, 178.1, 1);
  EXPECT_NEAR(left_s, 39.4, 1);
  EXPECT_NEAR(up_s, 11.8, 1);
  EXPECT_NEAR(speed_s, 182.7, 1);
  EXPECT_NEAR(slowest_m_s, 49.6, 0.2);
}

TEST(PaperLaw, HoldsASlotWithoutError) {
  PaperTest test;
  for (int i = 0; i < 600 * 20; ++i) test.Fly(test.Control());
  const StateError error = test.Error();
  EXPECT_NEAR(error.forward_m, 0, 0.01);
  EXPECT_NEAR(error.left_m, 0, 0.01);
  EXPECT_NEAR(error.up_m, 0, 0.01);
  EXPECT_NEAR(test.Control().speed_m_s, 50, 0.01);  // the whole speed comes from the integral
}

TEST(PaperLaw, IsTheSameWhicheverWayTheLeaderFlies) {
  PaperTest north;
  PaperTest turned;
  const double turn = 2.5;  // takes the course across pi
  for (VehicleState* state : {&turned.leader, &turned.wing}) {
    const Eigen::Vector2d position = FromLeaderFrame({state->east_m, state->north_m}, turn);
    state->east_m = position.x();
    state->north_m = position.y();
    state->course_rad += turn;
  }
  turned.leader.course_rad = WrapAngle(turned.leader.course_rad);
  for (int i = 0; i < 200 * 20; ++i) {
    north.Fly(north.Control());
    turned.Fly(turned.Control());
  }
  EXPECT_NEAR(turned.wing.course_rad, north.wing.course_rad + turn, 1e-6);
  EXPECT_NEAR(turned.Error().forward_m, north.Error().forward_m, 1e-4);
  EXPECT_NEAR(turned.Error().left_m, north.Error().left_m, 1e-4);
}

TEST(PaperLaw, CommandsTheCourseInTheTurnThatTheVehicleIsIn) {
  PaperTest test;
  test.wing.course_rad += 6 * pi;
  EXPECT_NEAR(test.Control().course_rad, pi / 2 + 6 * pi + 25, 1e-9);
}

TEST(PaperLaw, ResumesWithoutABumpAfterALinkLoss) {
  PaperTest test;
  AutopilotInput last;
  for (int i = 0; i < 250 * 20; ++i) {
    last = test.Control();
    test.Fly(last);
  }
  test.law.Freeze();
  for (int i = 0; i < 35 * 20; ++i) test.Fly(last);  // keeps its last command
  const AutopilotInput resumed = test.Control();
  EXPECT_NEAR(resumed.speed_m_s, last.speed_m_s, 1);
  EXPECT_NEAR(resumed.course_rad, last.course_rad, 0.02);
  EXPECT_NEAR(resumed.climb_rad, last.climb_rad, 0.02);
}

TEST(PaperLaw, DoesNotWindUpWhileTheVehicleCannotFollow) {
  // 20 s at the climb limit with 150 m still to go, then the slot comes to the UAV: without anti-windup the
  // integral would hold mu_c up.
  PaperTest test;
  test.wing.climb_rad = kModel.envelope.max_climb_rad;
  test.Control();
  for (int i = 0; i < 400; ++i) test.Control();
  test.leader.up_m = test.wing.up_m;
  test.wing.climb_rad = 0;
  test.Control();
  double climb = 0;
  for (int i = 0; i < 200; ++i) climb = test.Control().climb_rad;  // 10 s: the derivative has gone
  EXPECT_NEAR(climb, 0, 0.02);
}

TEST(PaperLaw, IsAsNewAfterAReset) {
  PaperTest test;
  for (int i = 0; i < 100; ++i) test.Control();
  test.law.Reset();
  EXPECT_NEAR(test.Control().speed_m_s, -75, 1e-9);
}

TEST(PaperParameters, AreTablesIAndII) {
  const PaperParameters parameters = PaperParametersFrom({});
  EXPECT_EQ(parameters.mixer.k_ex, 1.5);
  EXPECT_EQ(parameters.mixer.k_ev, 10);
  EXPECT_EQ(parameters.mixer.k_ey, 0.1);
  EXPECT_EQ(parameters.mixer.k_ephi, 10);
  EXPECT_EQ(parameters.mixer.k_ez, 0.04);
  EXPECT_EQ(parameters.mixer.k_emu, 5);
  EXPECT_EQ(parameters.speed.p, 3);
  EXPECT_EQ(parameters.speed.i, 0.1);
  EXPECT_EQ(parameters.course.p, 5);
  EXPECT_EQ(parameters.course.i, 1);
  EXPECT_EQ(parameters.climb.p, 5);
  EXPECT_EQ(parameters.climb.i, 0.1);
  for (const PidGains& pid : {parameters.speed, parameters.course, parameters.climb}) {
    EXPECT_EQ(pid.d, 1);
    EXPECT_EQ(pid.n, 1);
  }
}

TEST(PaperParameters, AreSetByName) {
  const PaperParameters parameters =
      PaperParametersFrom({{"k_ez", 0.08}, {"course_i", 2}, {"saturation_left_m", 80}});
  EXPECT_EQ(parameters.mixer.k_ez, 0.08);
  EXPECT_EQ(parameters.course.i, 2);
  EXPECT_EQ(parameters.mixer.saturation_left_m, 80);
  EXPECT_EQ(parameters.mixer.k_ex, 1.5);
}

TEST(PaperParameters, RefuseUnknownNamesAndBadValuesByName) {
  const auto reason = [](const std::map<std::string, double>& by_name) -> std::string {
    try {
      PaperParametersFrom(by_name);
    } catch (const std::invalid_argument& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_EQ(reason({{"k_e", 1}}), "control \"paper\" has no gain \"k_e\"");
  EXPECT_EQ(reason({{"speed_n", 0}}), "speed_n must be above 0");
  EXPECT_EQ(reason({{"climb_p", -1}}), "climb_p must not be negative");
  EXPECT_EQ(reason({{"saturation_up_m", 0}}), "saturation_up_m must be above 0");
}

}  // namespace
}  // namespace skein

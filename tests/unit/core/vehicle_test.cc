#include "core/vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/frames.h"
#include "unit/core/time_steps.h"

namespace skein {
namespace {

using std::numbers::pi;

VehicleState Fly(VehicleState state, const AutopilotInput& input, const VehicleModel& model,
                 double duration_s, double step_s) {
  const int steps = static_cast<int>(std::lround(duration_s / step_s));
  for (int i = 0; i < steps; ++i) state = Step(state, input, model, step_s);
  return state;
}

double DistanceBetween(const VehicleState& a, const VehicleState& b) {
  return (Position(a) - Position(b)).norm();
}

TEST(Vehicle, RespondsTowardsTheInput) {
  const VehicleState state{.speed_m_s = 50, .course_rad = 1, .climb_rad = 0.1};
  const AutopilotRates rates = Respond(state, {60, 0.5, 0.2}, {});
  EXPECT_NEAR(rates.acceleration_m_s2, 0.01 * 10, 1e-12);
  EXPECT_NEAR(rates.course_rate_rad_s, -0.1 * 0.5, 1e-12);
  EXPECT_NEAR(rates.climb_rate_rad_s, 0.1 * 0.1, 1e-12);
}

TEST(Vehicle, LimitsEveryRateInBothDirections) {
  const VehicleState state{.speed_m_s = 50};
  const AutopilotRates up = Respond(state, {500, 30, 30}, {});
  EXPECT_DOUBLE_EQ(up.acceleration_m_s2, 2);
  EXPECT_DOUBLE_EQ(up.course_rate_rad_s, 0.2);
  EXPECT_DOUBLE_EQ(up.climb_rate_rad_s, 0.2);
  const AutopilotRates down = Respond(state, {-500, -30, -30}, {});
  EXPECT_DOUBLE_EQ(down.acceleration_m_s2, -2);
  EXPECT_DOUBLE_EQ(down.course_rate_rad_s, -0.2);
  EXPECT_DOUBLE_EQ(down.climb_rate_rad_s, -0.2);
}

TEST(Vehicle, DoesNotRespondOutwardsAtALimit) {
  const VehicleState top{.speed_m_s = 90, .climb_rad = 0.35};
  EXPECT_EQ(Respond(top, {250, 0, 1}, {}).acceleration_m_s2, 0);
  EXPECT_EQ(Respond(top, {250, 0, 1}, {}).climb_rate_rad_s, 0);
  EXPECT_LT(Respond(top, {80, 0, 0}, {}).acceleration_m_s2, 0);
  EXPECT_LT(Respond(top, {80, 0, 0}, {}).climb_rate_rad_s, 0);
  const VehicleState bottom{.speed_m_s = 30, .climb_rad = -0.35};
  EXPECT_EQ(Respond(bottom, {0, 0, -1}, {}).acceleration_m_s2, 0);
  EXPECT_EQ(Respond(bottom, {0, 0, -1}, {}).climb_rate_rad_s, 0);
}

TEST(Vehicle, FollowsTheExactSolutionOfEquation1) {
  // v(t) = v_c + (v_0 - v_c) exp(-k t), and so on for course and climb.
  const VehicleState start{.speed_m_s = 50, .course_rad = 0.3, .climb_rad = 0};
  const VehicleState end = Fly(start, {70, 0.8, 0.1}, {}, 20, kStep);
  EXPECT_NEAR(end.speed_m_s, 70 - 20 * std::exp(-0.2), 1e-9);
  EXPECT_NEAR(end.course_rad, 0.8 - 0.5 * std::exp(-2.0), 1e-9);
  EXPECT_NEAR(end.climb_rad, 0.1 - 0.1 * std::exp(-2.0), 1e-9);
}

TEST(Vehicle, FliesStraightWhenNothingChanges) {
  const VehicleState start{.east_m = 10, .north_m = 20, .up_m = 30, .speed_m_s = 50, .course_rad = pi / 2};
  const VehicleState end = Fly(start, {50, pi / 2, 0}, {}, 100, kStep);
  EXPECT_NEAR(end.east_m, 10, 1e-6);
  EXPECT_NEAR(end.north_m, 20 + 5000, 1e-6);
  EXPECT_NEAR(end.up_m, 30, 1e-9);
}

TEST(Vehicle, RungeKuttaHasOrderFour) {
  // No limit is active: |dv| <= 0.01 * 30, |dphi| <= 0.1 * 1.5, |dmu| <= 0.1 * 0.25, and the speed stays
  // in 40..70.
  const VehicleState start{.speed_m_s = 40, .course_rad = -0.5, .climb_rad = -0.1};
  const AutopilotInput input{70, 1, 0.15};
  const VehicleState reference = Fly(start, input, {}, 40, 0.001);
  double previous = 0;
  for (const double step_s : {2.0, 1.0, 0.5}) {
    const double error = DistanceBetween(Fly(start, input, {}, 40, step_s), reference);
    if (previous > 0) {
      EXPECT_NEAR(previous / error, 16, 1.5) << "step " << step_s;
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-4);
}

TEST(Vehicle, NeverLeavesTheEnvelopeWhateverTheInput) {
  const unsigned seed = 20260101;
  std::mt19937 random(seed);
  SCOPED_TRACE(seed);
  std::uniform_real_distribution<double> speed(-300, 500), angle(-30, 30);
  const VehicleModel model;
  VehicleState state{.speed_m_s = 60};
  for (int i = 0; i < 20'000; ++i) {
    const VehicleState before = state;
    state = Step(state, {speed(random), angle(random), angle(random)}, model, kStep);
    ASSERT_GE(state.speed_m_s, 30);
    ASSERT_LE(state.speed_m_s, 90);
    ASSERT_LE(std::abs(state.climb_rad), 0.35);
    ASSERT_LE(std::abs(state.speed_m_s - before.speed_m_s), 2 * kStep + 1e-12);
    ASSERT_LE(std::abs(state.course_rad - before.course_rad), 0.2 * kStep + 1e-12);
    ASSERT_LE(std::abs(state.climb_rad - before.climb_rad), 0.2 * kStep + 1e-12);
    ASSERT_LE(DistanceBetween(state, before), 90 * kStep + 1e-9);
  }
}

TEST(Vehicle, ReachesALimitAndStaysExactlyThere) {
  // slower).
  VehicleState state{.speed_m_s = 50};
  state = Fly(state, {250, 0, 5}, {}, 60, kStep);
  EXPECT_EQ(state.speed_m_s, 90);
  EXPECT_EQ(state.climb_rad, 0.35);
  const VehicleState later = Fly(state, {250, 0, 5}, {}, 100, kStep);
  EXPECT_NEAR(later.east_m - state.east_m, 9000 * std::cos(0.35), 1e-6);
  EXPECT_NEAR(later.up_m - state.up_m, 9000 * std::sin(0.35), 1e-6);
}

TEST(Vehicle, ReachesALimitAtTheSameTimeWhateverTheStep) {
  // From 50 m/s no rate limit is active: 250 - 200 exp(-0.01 t): 90 after t = 100 ln(200/160) = 22.3 s.
  const double reach_s = 100 * std::log(200.0 / 160.0);
  for (const double step_s : {0.05, 0.01}) {
    VehicleState state{.speed_m_s = 50};
    double t = 0;
    while (state.speed_m_s < 90 && t < 60) {
      state = Step(state, {250, 0, 0}, {}, step_s);
      t += step_s;
    }
    EXPECT_NEAR(t, reach_s, step_s);
  }
}

TEST(Vehicle, LeavesALimitAsSoonAsTheInputAllows) {
  VehicleState state{.speed_m_s = 90, .climb_rad = 0.35};
  state = Step(state, {80, 0, 0}, {}, kStep);
  EXPECT_LT(state.speed_m_s, 90);
  EXPECT_LT(state.climb_rad, 0.35);
}

TEST(Vehicle, ComesBackFromOutsideAtTheLimitRateAndStopsAtTheLimit) {
  VehicleState state{.speed_m_s = 95, .climb_rad = -0.5};
  state = Fly(state, {250, 0, -5}, {}, 0.5, kStep);
  EXPECT_NEAR(state.speed_m_s, 94, 1e-9);
  EXPECT_NEAR(state.climb_rad, -0.4, 1e-9);
  state = Fly(state, {250, 0, -5}, {}, 5, kStep);
  EXPECT_EQ(state.speed_m_s, 90);
  EXPECT_EQ(state.climb_rad, -0.35);
  const AutopilotRates rates = Respond({.speed_m_s = 20, .climb_rad = 0.5}, {0, 0, 5}, {});
  EXPECT_EQ(rates.acceleration_m_s2, 2);
  EXPECT_EQ(rates.climb_rate_rad_s, -0.2);
}

TEST(Vehicle, ChecksItsModel) {
  EXPECT_NO_THROW(Check(VehicleModel{}));
  const auto refused = [](auto change) {
    VehicleModel model;
    change(model);
    EXPECT_THROW(Check(model), std::invalid_argument);
  };
  refused([](VehicleModel& m) { m.gains.speed_per_s = 0; });
  refused([](VehicleModel& m) { m.gains.course_per_s = -1; });
  refused([](VehicleModel& m) { m.gains.climb_per_s = std::nan(""); });
  refused([](VehicleModel& m) { m.envelope.min_speed_m_s = -1; });
  refused([](VehicleModel& m) { m.envelope.max_speed_m_s = m.envelope.min_speed_m_s; });
  refused([](VehicleModel& m) { m.envelope.max_acceleration_m_s2 = 0; });
  refused([](VehicleModel& m) { m.envelope.max_course_rate_rad_s = 0; });
  refused([](VehicleModel& m) { m.envelope.max_climb_rad = 2; });
  refused([](VehicleModel& m) { m.envelope.max_climb_rate_rad_s = 0; });
}

TEST(Vehicle, BanksIntoTheTurn) {
  // tan(bank) = v * rate / g: 50 m/s at 0.1 rad/s is 0.50986 -> 27.0 degrees.
  EXPECT_NEAR(BankAngle(50, 0, -0.1), 0.47148, 1e-4);
  EXPECT_NEAR(BankAngle(50, 0, 0.1), -0.47148, 1e-4);
  EXPECT_EQ(BankAngle(50, 0, 0), 0);
}

}  // namespace
}  // namespace skein

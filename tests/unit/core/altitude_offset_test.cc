#include "core/altitude_offset.h"
#include "unit/core/time_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace skein {
namespace {

TEST(AltitudeRamp, ClimbsTwoHundredMetresInTwentyFiveSeconds) {
  // 5 s to reach 10 m/s at 2 m/s^2 (25 m), the same to stop, 150 m at 10 m/s in between: 5 + 15 + 5 s.
  AltitudeRamp ramp;
  ramp.SetTarget(200);
  EXPECT_NEAR(ramp.RemainingTime(), 25, 1e-9);
  double time = 0;
  while (!ramp.settled() && time < 60) {
    ramp.Advance(kStep);
    time += kStep;
    if (std::abs(time - 5) < 1e-6) {
      EXPECT_NEAR(ramp.now().rate_m_s, 10, 0.01);
      EXPECT_NEAR(ramp.now().height_m, 25, 0.5);
    }
  }
  EXPECT_NEAR(time, 25, 0.5);
  EXPECT_DOUBLE_EQ(ramp.now().height_m, 200);
}

TEST(AltitudeRamp, KeepsItsLimitsAndNeverOvershootsWhateverTheTargetDoes) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<> targets(-300, 300);
  AltitudeRamp ramp;
  for (int change = 0; change < 200; ++change) {
    ramp.SetTarget(targets(random));
    const double start = ramp.now().height_m;
    const double stop_way = ramp.now().rate_m_s * ramp.now().rate_m_s / (2 * 2.0);
    const double low = std::min(start, ramp.target_m()) - stop_way - 1e-6;
    const double high = std::max(start, ramp.target_m()) + stop_way + 1e-6;
    const int steps = static_cast<int>(random() % 1000);
    for (int i = 0; i < steps; ++i) {
      const AltitudeOffset before = ramp.now();
      ramp.Advance(kStep);
      ASSERT_LE(std::abs(ramp.now().rate_m_s), 10 + 1e-9);
      ASSERT_LE(std::abs(ramp.now().rate_m_s - before.rate_m_s), 2 * 2 * kStep + 1e-9);
      ASSERT_GE(ramp.now().height_m, low);
      ASSERT_LE(ramp.now().height_m, high);
      // Where it is follows from its rate; half a step of braking at most is left over at the end.
      const double mean_rate = 0.5 * (before.rate_m_s + ramp.now().rate_m_s);
      ASSERT_NEAR(ramp.now().height_m - before.height_m, mean_rate * kStep, 2 * kStep * kStep + 1e-9);
    }
  }
}

TEST(AltitudeRamp, TellsTheTimeThatIsLeftInMidClimb) {
  AltitudeRamp ramp({100, 10, 0});
  ramp.SetTarget(0);  // stop first: 5 s, 25 m farther up; then 125 m down: 5 + 7.5 + 5 s
  EXPECT_NEAR(ramp.RemainingTime(), 22.5, 1e-9);
  double time = 0;
  while (!ramp.settled() && time < 60) {
    ramp.Advance(kStep);
    time += kStep;
  }
  EXPECT_NEAR(time, 22.5, 0.5);
}

TEST(AltitudeRamp, DoesNotJumpOverAGapInTime) {
  AltitudeRamp ramp;
  ramp.SetTarget(200);
  ramp.Advance(10);  // 5 s to 10 m/s, 5 s at it
  EXPECT_NEAR(ramp.now().height_m, 75, 1);
  ramp.Advance(1000);
  EXPECT_TRUE(ramp.settled());
}

TEST(AltitudeRamp, StaysWhereItIsWithoutATarget) {
  AltitudeRamp ramp;
  ramp.Advance(1);
  ramp.Advance(0);
  EXPECT_TRUE(ramp.settled());
  EXPECT_EQ(ramp.now().height_m, 0);
  EXPECT_EQ(ramp.RemainingTime(), 0);
}

}  // namespace
}  // namespace skein

#include "core/pid.h"
#include "unit/core/time_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace skein {
namespace {

TEST(Pid, IsProportionalToTheFirstError) {
  Pid pid({.p = 3, .i = 0.1, .d = 1, .n = 1});
  EXPECT_DOUBLE_EQ(pid.Update(2, kStep), 6);
}

TEST(Pid, IntegratesAConstantErrorByItsArea) {
  Pid pid({.i = 0.5});
  double output = pid.Update(4, kStep);
  for (int i = 0; i < 200; ++i) output = pid.Update(4, kStep);
  EXPECT_NEAR(output, 0.5 * 4 * 10, 1e-9);
}

TEST(Pid, IntegratesARampExactly) {
  Pid pid({.i = 2});
  double output = 0;
  for (int i = 0; i <= 100; ++i) output = pid.Update(3 * i * kStep, kStep);
  EXPECT_NEAR(output, 2 * 3 * 25 / 2.0, 1e-9);  // 2 * integral of 3 t over 5 s
}

TEST(Pid, DerivativeOfARampApproachesItsSlopeWithTheFiltersTimeConstant) {
  // D N / (1 + N/s) on the ramp m t is D m (1 - exp(-N t)).
  Pid pid({.d = 2, .n = 4});
  for (int i = 0; i <= 100; ++i) {
    const double t = i * kStep;
    EXPECT_NEAR(pid.Update(3 * t, kStep), 2 * 3 * (1 - std::exp(-4 * t)), 1e-9);
  }
}

TEST(Pid, DerivativeOfAConstantFadesAway) {
  Pid pid({.d = 1, .n = 1});
  pid.Update(0, kStep);
  const double kick = pid.Update(1, kStep);
  EXPECT_NEAR(kick, (1 - std::exp(-kStep)) / kStep, 1e-12);
  double output = kick;
  for (int i = 0; i < 20; ++i) output = pid.Update(1, kStep);
  EXPECT_NEAR(output, kick * std::exp(-1.0), 1e-12);
}

TEST(Pid, StaysStableWhenTheFilterIsFasterThanTheStep) {
  Pid pid({.d = 1, .n = 1000});
  pid.Update(0, kStep);
  EXPECT_NEAR(pid.Update(1, kStep), 1 / kStep, 1e-9);
  EXPECT_NEAR(pid.Update(1, kStep), 0, 1e-9);
}

TEST(Pid, DoesNotWindUpWhileTheResponseIsAtItsLimit) {
  Pid pid({.i = 1});
  pid.Update(10, kStep);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pid.Update(10, kStep, AtLimit::kUpper), 0);
  Pid negative({.i = 1});
  negative.Update(-10, kStep);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(negative.Update(-10, kStep, AtLimit::kLower), 0);
}

TEST(Pid, UnwindsAtALimit) {
  Pid pid({.i = 1});
  pid.Update(-10, kStep);
  EXPECT_NEAR(pid.Update(-10, kStep, AtLimit::kUpper), -0.5, 1e-12);
}

TEST(Pid, ResumesWhereItWasFrozen) {
  Pid pid({.p = 3, .i = 0.1, .d = 1, .n = 1});
  double output = 0;
  for (int i = 0; i <= 40; ++i) output = pid.Update(5 - 0.1 * i, kStep);
  pid.Freeze();
  EXPECT_DOUBLE_EQ(pid.Update(1, 35), output);  // 35 s later
}

TEST(Pid, AnErrorThatJumpedWhileFrozenGivesNoDerivative) {
  Pid pid({.i = 1, .d = 1, .n = 1});
  pid.Update(0, kStep);
  pid.Freeze();
  EXPECT_EQ(pid.Update(100, kStep), 0);
}

TEST(Pid, IsAsNewAfterAReset) {
  Pid pid({.p = 1, .i = 1, .d = 1});
  for (int i = 0; i < 10; ++i) pid.Update(i, kStep);
  pid.Freeze();
  pid.Reset();
  EXPECT_DOUBLE_EQ(pid.Update(7, kStep), 7);
  EXPECT_NEAR(pid.Update(7, kStep), 7 + 7 * kStep, 1e-12);
}

TEST(Pid, ChecksItsGains) {
  EXPECT_NO_THROW(Pid(PidGains{}));
  EXPECT_THROW(Pid({.p = -1}), std::invalid_argument);
  EXPECT_THROW(Pid({.i = -1}), std::invalid_argument);
  EXPECT_THROW(Pid({.d = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(Pid({.n = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace skein

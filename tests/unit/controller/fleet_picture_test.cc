#include "controller/fleet_picture.h"
#include "unit/controller/flight_bench.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::controller {
namespace {

constexpr bus::Utime kStart = 1'577'836'800'000'000;

VehicleState At(double east_m) { return {east_m, 0, 1000, 50, 0, 0}; }

class VehicleViewTest : public testing::Test {
 protected:
  /// @return whether it was taken.
  bool Hear(double east_m, bus::Utime stamp) {
    view_.fresh = false;
    view_.Take(At(east_m), stamp, now_);
    return view_.fresh;
  }

  VehicleView view_;
  bus::Utime now_ = kStart;
};

TEST_F(VehicleViewTest, TakesWhatIsNewerOnly) {
  EXPECT_TRUE(Hear(1, kStart));
  EXPECT_FALSE(Hear(2, kStart)) << "the same again";
  EXPECT_FALSE(Hear(3, kStart - FlightBench::kTick)) << "late by jitter";
  now_ += FlightBench::kTick;
  EXPECT_TRUE(Hear(4, now_));
  EXPECT_DOUBLE_EQ(view_.state->east_m, 4);
}

TEST_F(VehicleViewTest, TakesAClockThatWasSetBackAfterThreeRisingStamps) {
  EXPECT_TRUE(Hear(1, kStart));
  const bus::Utime back = kStart - 60 * bus::kSecond;
  EXPECT_FALSE(Hear(2, back));
  EXPECT_FALSE(Hear(3, back + FlightBench::kTick));
  EXPECT_TRUE(Hear(4, back + 2 * FlightBench::kTick));
  EXPECT_TRUE(Hear(5, back + 3 * FlightBench::kTick));
}

TEST_F(VehicleViewTest, IsNotLedAstrayByOneStampFarAhead) {
  EXPECT_TRUE(Hear(1, kStart));
  EXPECT_FALSE(Hear(2, kStart + 3600 * bus::kSecond));
  now_ += FlightBench::kTick;
  EXPECT_TRUE(Hear(3, now_));
}

TEST_F(VehicleViewTest, TakesAClockThatRunsAheadAsOfTheTick) {
  for (int i = 0; i < 3; ++i) Hear(i, kStart + 3600 * bus::kSecond + i * FlightBench::kTick);
  EXPECT_TRUE(view_.fresh);
  EXPECT_EQ(view_.state_utime, now_);
}

TEST_F(VehicleViewTest, IsDeadReckonedStraightOnAndLevelsOff) {
  Hear(0, kStart);
  view_.state->climb_rad = 0.2;
  // An independent way: its motion in steps, with no command after one second.
  VehicleState uav = *view_.state;
  for (int i = 0; i < 1200; ++i) uav = Step(uav, {50, 0, i < 20 ? 0.2 : 0.0}, VehicleModel(), 0.05);
  const VehicleState later = view_.At(kStart + 60 * bus::kSecond);
  EXPECT_NEAR(later.up_m, uav.up_m, 1);
  EXPECT_NEAR(later.east_m, uav.east_m, 30) << "a climb is flown a little slower over ground";
}

}  // namespace
}  // namespace skein::controller

#include "core/leader.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

Path SpeedingUp() {
  return Path(0, {{5000, {0, 0}, 0, 0, 0}}, {{500, 100, 40}, {2500, 100, 80}}, std::nullopt);
}

/// Arc length at a time by 1 ms Euler steps at the middle.
double Slowly(const Path& path, double arc_m, double duration_s) {
  const int steps = static_cast<int>(std::lround(duration_s / 1e-3));
  for (int i = 0; i < steps; ++i)
    arc_m += 1e-3 * path.At(arc_m + 0.5e-3 * path.At(arc_m).speed_m_s).speed_m_s;
  return arc_m;
}

TEST(VirtualLeader, FliesAtThePlannedSpeed) {
  VirtualLeader leader(SpeedingUp(), 0, 100);
  for (int tick = 1; tick <= 800; ++tick) leader.AdvanceTo(100 + 0.05 * tick);
  EXPECT_NEAR(leader.arc_m(), Slowly(leader.path(), 0, 40), 1e-3);
  EXPECT_NEAR(leader.time_s(), 140, 1e-9);
}

TEST(VirtualLeader, OneLongStepIsAsGoodAsManyShortOnes) {
  VirtualLeader once(SpeedingUp(), 0, 0), often(SpeedingUp(), 0, 0);
  once.AdvanceTo(37.3);
  for (int tick = 1; tick <= 746; ++tick) often.AdvanceTo(0.05 * tick);
  EXPECT_NEAR(once.arc_m(), often.arc_m(), 1e-4);
}

TEST(VirtualLeader, RemembersTenSecondsAndLooksALittleAhead) {
  VirtualLeader leader(SpeedingUp(), 0, 0);
  leader.AdvanceTo(30);
  for (const double time : {20.0, 21.234, 29.99, 30.0, 31.5}) {
    EXPECT_NEAR(leader.ArcAt(time), Slowly(leader.path(), 0, time), 2e-3) << time;
  }
  // Older than the history: still a sensible guess.
  EXPECT_NEAR(leader.ArcAt(15), Slowly(leader.path(), 0, 15), 0.01);
  EXPECT_EQ(leader.ArcAt(30), leader.arc_m());
}

TEST(VirtualLeader, DoesNotGoBack) {
  VirtualLeader leader(Path::Straight({0, 0}, 0, 100, 50), 0, 0);
  leader.AdvanceTo(10);
  leader.AdvanceTo(10);
  leader.AdvanceTo(4);
  EXPECT_EQ(leader.time_s(), 10);
  EXPECT_NEAR(leader.arc_m(), 500, 1e-9);
}

TEST(VirtualLeader, GoesOnFromWhereItIsOnANewPath) {
  VirtualLeader leader(Path::Straight({0, 0}, 0, 100, 50), 0, 0);
  leader.AdvanceTo(10);
  leader.SetPath(Path(0, {{9000, {0, 0}, 0, 0, 0}}, {{500, 100, 50}, {4500, 100, 70}}, std::nullopt));
  EXPECT_NEAR(leader.arc_m(), 500, 1e-9);
  EXPECT_NEAR(leader.ArcAt(4), 200, 1e-9);
  leader.AdvanceTo(20);
  EXPECT_GT(leader.arc_m(), 1000);
}

}  // namespace
}  // namespace skein

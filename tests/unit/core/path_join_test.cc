#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "core/path.h"
#include "core/path_connect.h"
#include "core/path_limits.h"
#include "core/path_section.h"
#include "path_checks.h"

namespace skein {
namespace {

PathLimits TriangleLimits() { return LimitsOf({}, {{-1000, 0, 0}, {-1433, 250, 0}, {-1433, -250, 0}}); }

Path Square(double east_m, double size_m, double up_m, double speed_m_s) {
  const PathResult result = PlanWaypoints({{east_m, 0, up_m, speed_m_s},
                                           {east_m + size_m, 0, up_m + 150, speed_m_s + 5},
                                           {east_m + size_m, size_m, up_m, speed_m_s},
                                           {east_m, size_m, up_m + 50, speed_m_s}},
                                          true, TriangleLimits());
  return result.path.value();
}

/// Two points of two paths are the same place, flown in the same way.
void ExpectSame(const PathPoint& one, const PathPoint& other, double tolerance = 1e-5) {
  ASSERT_LT((one.position - other.position).norm(), tolerance);
  ASSERT_NEAR(std::remainder(one.course_rad - other.course_rad, 2 * M_PI), 0, 1e-8);
  ASSERT_NEAR(one.curvature_per_m, other.curvature_per_m, 1e-9);
  ASSERT_NEAR(one.up_m, other.up_m, 1e-6);
  ASSERT_NEAR(one.up_slope, other.up_slope, 1e-8);
  ASSERT_NEAR(one.speed_m_s, other.speed_m_s, 1e-6);
  ASSERT_NEAR(one.speed_slope_per_s, other.speed_slope_per_s, 1e-8);
}

TEST(Section, UnrollsTheSameCurve) {
  const Path path = Square(0, 12000, 1000, 50);
  const double from = path.end_arc_m() - 4321, to = from + 1.7 * path.lap_m();
  const PathSection section = Section(path, from, to);
  const Path unrolled(section.start_arc_m, section.pieces, section.knots, std::nullopt);
  EXPECT_NEAR(unrolled.start_arc_m(), from, 1e-9);
  EXPECT_NEAR(unrolled.end_arc_m(), to, 1e-6);
  for (double arc = from; arc < to; arc += 13) {
    ExpectSame(unrolled.At(arc), path.At(arc));
    ASSERT_NEAR(unrolled.At(arc).course_rad, path.At(arc).course_rad, 1e-8);
  }
}

TEST(Section, ReachesPastAnOpenEnd) {
  const Path path(0, {{100, {0, 0}, 0, 0.001, 0.001}}, {{0, 100, 50}}, std::nullopt);
  const PathSection section = Section(path, -500, 5000);
  EXPECT_EQ(section.start_arc_m, 0);
  const Path unrolled(0, section.pieces, section.knots, std::nullopt);
  for (double arc = 0; arc < 6000; arc += 100) ExpectSame(unrolled.At(arc), path.At(arc));
}

TEST(Connect, LeadsFromAnyPoseToAnyOther) {
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  const TurnRate tight{1.0 / 1500, 1e-6}, wide{1.0 / 2500, 5e-7};
  int found = 0, near = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double size = trial % 3 == 0 ? 3000 : 30000;
    const Pose from{{uniform(-size, size), uniform(-size, size)}, uniform(-10, 10)};
    const Pose to{{uniform(-size, size), uniform(-size, size)}, uniform(-10, 10)};
    const auto way = Connect(from, to, tight, wide);
    if (trial % 3 == 0) {
      ++near;
      found += way.has_value();
    } else {
      ASSERT_TRUE(way) << "seed " << seed << ", trial " << trial;
    }
    if (!way) continue;
    PieceChain chain(from);
    chain.Lay(way->first);
    chain.LayStraight(way->straight_m);
    chain.Lay(way->second);
    ASSERT_LT((chain.end().position - to.position).norm(), 1e-5) << "seed " << seed << ", trial " << trial;
    ASSERT_NEAR(std::remainder(chain.end().course_rad - to.course_rad, 2 * M_PI), 0, 1e-8);
  }
  std::cout << found << " of " << near << " poses close together connected" << std::endl;
  EXPECT_GT(found, 0.9 * near);
}

TEST(Connect, StraightAheadIsStraight) {
  const auto way = Connect({{0, 0}, 1}, {5000 * Direction(1), 1 + 2 * M_PI}, {0.001, 1e-6}, {0.0005, 1e-6});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length_m(), 5000, 1e-3);
}

TEST(Connect, IsAsShortAsTheSimplePathWhenRampsAreShort) {
  // With (almost) no ramps the turns are arcs: half circle, straight back, half circle.
  const double radius = 1000;
  const auto way = Connect({{0, 0}, 0}, {{-3000, 2 * radius}, M_PI}, {1 / radius, 10}, {1 / radius, 10});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length_m(), M_PI * radius + 3000, 1);
}

TEST(Join, IsSmoothFromTheMiddleOfATurnAndRepeatsTheLoop) {
  const PathLimits limits = TriangleLimits();
  const Path current = Square(0, 12000, 1000, 50), next = Square(-30000, 15000, 1200, 45);
  double in_turn = 0;
  while (std::abs(current.At(in_turn).curvature_per_m) < 3e-4) in_turn += 10;
  const PathResult result = Join(current, in_turn, next, 0, 3000, limits);
  ASSERT_TRUE(result.path) << result.reason;
  const Path& joined = *result.path;
  for (double arc = in_turn - 3000; arc <= in_turn; arc += 50) ExpectSame(joined.At(arc), current.At(arc));
  ExpectSmooth(joined, in_turn - 1000, joined.end_arc_m() + 1000);
  ASSERT_TRUE(joined.closed());
  EXPECT_NEAR(joined.lap_m(), next.lap_m(), 1e-5);
  const double loop = *joined.loop_start_m();
  for (double along = 0; along < next.lap_m(); along += 100) {
    ExpectSame(joined.At(loop + along), next.At(along));
    ExpectSame(joined.At(loop + along + next.lap_m()), next.At(along));
  }
  ExpectSlotsWithin(joined, limits, in_turn, loop + 5000, 1.05);
}

TEST(Join, ResumesAPathAtItsNextStraightPoint) {
  const PathLimits limits = TriangleLimits();
  const Path path = Square(0, 12000, 1000, 50);
  double in_turn = path.lap_m();
  while (std::abs(path.At(in_turn).curvature_per_m) < 3e-4) in_turn += 10;
  const PathResult held = Loiter(path, in_turn - 2000, 3000, limits);
  ASSERT_TRUE(held.path) << held.reason;
  const double now = in_turn + 20000;
  const PathResult resumed = Join(*held.path, now, path, in_turn, 3000, limits);
  ASSERT_TRUE(resumed.path) << resumed.reason;
  const double target = *StraightPoint(path, in_turn);
  EXPECT_GT(target, in_turn);
  EXPECT_NEAR(path.At(target).curvature_per_m, 0, 1e-9);
  const double loop = *resumed.path->loop_start_m();
  ExpectSame(resumed.path->At(loop + 1), path.At(target + 1));
  ExpectSmooth(*resumed.path, now - 3000, loop + path.lap_m() + 1000);
}

TEST(Join, FliesCirclesWhenTheClimbNeedsMoreLength) {
  const PathLimits limits = TriangleLimits();
  const Path current = Path::Straight({0, 0}, 0, 500, 50);
  const PathResult high = PlanWaypoints({{4000, 0, 2500, 50}, {20000, 0, 2500, 50}}, false, limits);
  ASSERT_TRUE(high.path) << high.reason;
  const PathResult result = Join(current, 1000, *high.path, 0, 3000, limits);
  ASSERT_TRUE(result.path) << result.reason;
  ExpectSmooth(*result.path, 0, result.path->end_arc_m() + 1000);
  ExpectSlotsWithin(*result.path, limits, 1000, result.path->end_arc_m(), 1.05);
  EXPECT_NEAR(result.path->At(1e6).up_m, 2500, 1e-9);
}

TEST(Join, OntoItselfStraightAheadChangesNothing) {
  const PathLimits limits = TriangleLimits();
  const Path path = Path::Straight({0, 0}, 1, 500, 50);
  const PathResult result = Join(path, 1000, path, 1000, 3000, limits);
  ASSERT_TRUE(result.path) << result.reason;
  for (double arc = 0; arc < 9000; arc += 100) ExpectSame(result.path->At(arc), path.At(arc));
}

TEST(Join, FromBeforeTheStartOfAPath) {
  const PathLimits limits = TriangleLimits();
  const Path current(5000, {{1000, {0, 0}, 0, 0, 0}}, {{5000, 100, 50}}, std::nullopt);
  const PathResult result = Join(current, 3000, Square(0, 12000, 1000, 50), 0, 3000, limits);
  ASSERT_TRUE(result.path) << result.reason;
  ExpectSame(result.path->At(3000), current.At(3000));
  ExpectSame(result.path->At(1000), current.At(1000));
}

TEST(Join, SlotsAheadOfTheLeaderAreNotMoved) {
  const PathLimits limits = LimitsOf({}, {{700, 0, 0}, {-300, 200, 0}});
  const Path current = Path::Straight({0, 0}, 0, 500, 50);
  const PathResult result = Join(current, 1000, Square(-9000, 12000, 1000, 50), 0, 3000, limits);
  ASSERT_TRUE(result.path) << result.reason;
  for (double arc = 0; arc <= 1700; arc += 10) ExpectSame(result.path->At(arc), current.At(arc));
}

TEST(Join, WorksForAFormationThatWasWidenedInATurn) {
  // The turn that is flown is too tight for the new slots; the way out of it is still found.
  const PathLimits narrow = LimitsOf({}, {{-1000, 100, 0}, {-1000, -100, 0}});
  const PathLimits wide = LimitsOf({}, {{-1000, 600, 0}, {-1000, -600, 0}});
  const PathResult turn = PlanLegs({0, 0}, 0, 1000, 50, {{.turn_rad = 6}}, narrow);
  ASSERT_TRUE(turn.path) << turn.reason;
  ASSERT_NE(Violation(*turn.path, wide), "");
  const PathResult next =
      PlanWaypoints({{0, 0, 1000, 50}, {20000, 0, 1000, 50}, {20000, 20000, 1000, 50}}, true, wide);
  ASSERT_TRUE(next.path) << next.reason;
  const PathResult result = Join(*turn.path, 1500, *next.path, 0, 3000, wide);
  const PathResult loiter = Loiter(*turn.path, 1500, 3000, wide);
  ASSERT_TRUE(result.path) << result.reason;
  ASSERT_TRUE(loiter.path) << loiter.reason;
  for (const Path& path : {*result.path, *loiter.path}) {
    ExpectSmooth(path, 0, path.end_arc_m() + 1000);
    ExpectSame(path.At(1500), turn.path->At(1500));
  }
}

TEST(Join, RefusesAPathThatIsNowhereStraight) {
  const Path circle(0, {{100, {0, 0}, 0, 0.0005, 0.0005}}, {{0, 500, 50}}, std::nullopt);
  const PathResult result = Join(Path::Straight({0, 0}, 0, 500, 50), 0, circle, 0, 3000, TriangleLimits());
  EXPECT_FALSE(result.path);
  EXPECT_NE(result.reason.find("nowhere straight"), std::string::npos);
}

TEST(Join, OneAfterTheOtherAtRandomTimesStaysSmoothAndWithinLimits) {
  const unsigned seed = 777;
  std::mt19937 random(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  int joins = 0, refused = 0, loiters = 0;
  for (int flight = 0; flight < 60; ++flight) {
    std::vector<SlotOffset> slots{{-1000, 0, 0}};
    for (int i = 0; i < flight % 4; ++i) slots.push_back({uniform(-2000, 200), uniform(-400, 400), 0});
    const PathLimits limits = LimitsOf({}, slots);
    const double keep = 100 - limits.hindmost_m;
    Path path = Path::Straight({0, 0}, uniform(-4, 4), 1000, uniform(45, 60));
    double arc = 0;
    for (int change = 0; change < 12; ++change) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", flight " + std::to_string(flight) + ", change " +
                   std::to_string(change));
      PathResult result;
      if (change % 5 == 4) {
        result = Loiter(path, arc, keep, limits);
        ++loiters;
      } else {
        std::vector<Waypoint> waypoints;
        const double size = uniform(8000, 30000), speed = uniform(45, 60);
        for (int i = 0; i < 4; ++i) {
          waypoints.push_back(
              {uniform(0, size), uniform(0, size), uniform(900, 1100), speed + uniform(0, 5)});
        }
        const PathResult next = PlanWaypoints(waypoints, change % 2 == 0, limits);
        if (!next.path) continue;
        result = Join(path, arc, *next.path, change % 3 == 0 ? uniform(0, 20000) : 0, keep, limits);
        ++joins;
        if (!result.path) {
          std::cout << "flight " << flight << ", change " << change << ": " << result.reason << std::endl;
          ++refused;
          continue;
        }
      }
      ASSERT_TRUE(result.path) << result.reason;
      for (double back = 0; back < keep; back += 20) {
        ExpectSame(result.path->At(arc - back), path.At(arc - back));
      }
      const double until = arc + uniform(100, 30000);
      ExpectSmooth(*result.path, arc - keep, until, 1e-3, 5);
      ExpectSlotsWithin(*result.path, limits, arc, until, 1.05);
      if (testing::Test::HasFatalFailure()) return;
      path = *result.path;
      arc = until;
    }
  }
  std::cout << joins << " joins, " << refused << " of them refused, " << loiters << " loiters, seed " << seed
            << std::endl;
  EXPECT_EQ(refused, 0);
}

TEST(Loiter, WindsIntoTheSmallestCircleTheWayItTurns) {
  const PathLimits limits = TriangleLimits();
  for (const double curvature : {0.0, 1.0 / 3000, -1.0 / 3000}) {
    const Path path(0, {{9000, {0, 0}, 0, curvature, curvature}}, {{0, 1000, 50}}, std::nullopt);
    const PathResult result = Loiter(path, 5000, 3000, limits);
    ASSERT_TRUE(result.path) << result.reason;
    const double radius = *LoiterRadius(limits, 50);
    EXPECT_NEAR(result.path->At(1e5).curvature_per_m, (curvature < 0 ? -1 : 1) / radius, 1e-9);
    ExpectSmooth(*result.path, 2000, 30000);
    ExpectSlotsWithin(*result.path, limits, 5000, 20000, 1.05);
  }
}

TEST(Loiter, LevelsOffFromAClimb) {
  const PathLimits limits = TriangleLimits();
  const Path path(0, {{9000, {0, 0}, 0, 0, 0}}, {{0, 1000, 50}, {4000, 1300, 60}}, std::nullopt);
  for (double arc = 0; arc <= 4000; arc += 250) {
    const PathResult result = Loiter(path, arc, 3000, limits);
    ASSERT_TRUE(result.path) << result.reason;
    ExpectSmooth(*result.path, std::max(0.0, arc - 3000) + 1, 15000);
    ExpectSlotsWithin(*result.path, limits, arc, arc + 10000, 1.05);
    EXPECT_GE(result.path->At(1e5).up_m, path.At(arc).up_m - 1e-9);
    EXPECT_LT(result.path->At(1e5).up_m, path.At(arc).up_m + 40);
    EXPECT_EQ(result.path->At(1e5).up_slope, 0);
  }
}

TEST(Loiter, ChangesToASpeedThatHasACircle) {
  const PathLimits limits = TriangleLimits();
  for (const double speed : {34.0, 85.0}) {
    const PathResult result = Loiter(Path::Straight({0, 0}, 0, 1000, speed), 5000, 3000, limits);
    ASSERT_TRUE(result.path) << result.reason;
    ExpectSmooth(*result.path, 2000, 30000);
    ExpectSlotsWithin(*result.path, limits, 5000, 30000, 1.05);
    EXPECT_LT(*LoiterRadius(limits, speed), 3000);
  }
}

TEST(LoiterRadius, IsWhatTheSlowestAndFastestSlotAndTheCourseRateAllow) {
  // One UAV: 50 m/s at 0.12 rad/s.
  EXPECT_NEAR(*LoiterRadius(LimitsOf({}, {{-1000, 0, 0}}), 50), 50 / 0.12, 1e-9);
  // 250 m to either side at 50 m/s: the inner one at least 33 m/s.
  EXPECT_NEAR(*LoiterRadius(TriangleLimits(), 50), 250 / (1 - 33.0 / 50), 1e-9);
  // A long column: head and tail do not meet.
  const double radius = *LoiterRadius(LimitsOf({}, {{-1000, 0, 0}, {-21000, 0, 0}}), 50);
  EXPECT_GT(2 * M_PI * radius, 20300);
  EXPECT_LT(2 * M_PI * radius, 21000);
  PathLimits none = TriangleLimits();
  none.min_speed_m_s = 70;
  none.max_speed_m_s = 60;
  EXPECT_FALSE(LoiterRadius(none, 50));
  EXPECT_FALSE(Loiter(Path::Straight({0, 0}, 0, 1000, 50), 0, 3000, none).path);
}

}  // namespace
}  // namespace skein

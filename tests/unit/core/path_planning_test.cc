#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "core/path.h"
#include "core/path_limits.h"
#include "path_checks.h"

namespace skein {
namespace {

/// Three UAVs as in the turn scenario.
PathLimits TurnLimits() {
  return LimitsOf(std::vector<VehicleModel>(3), {{-1000, 0, 0}, {-1000, 500, 0}, {-1000, -500, 0}});
}

TEST(LimitsOf, TakesTheShareOfTheWeakestMemberAndTheExtentOfTheSlots) {
  VehicleModel weak;
  weak.envelope = {40, 80, 1, 0.1, 0.2, 0.15};
  const PathLimits limits = LimitsOf({VehicleModel{}, weak}, {{-1000, 300, 0}, {-1500, -200, 10}}, 0.5);
  EXPECT_NEAR(limits.min_speed_m_s, 42, 1e-12);
  EXPECT_NEAR(limits.max_speed_m_s, 78, 1e-12);
  EXPECT_NEAR(limits.max_acceleration_m_s2, 0.5, 1e-12);
  EXPECT_NEAR(limits.max_course_rate_rad_s, 0.05, 1e-12);
  EXPECT_NEAR(limits.max_climb_rad, 0.1, 1e-12);
  EXPECT_NEAR(limits.max_climb_rate_rad_s, 0.075, 1e-12);
  EXPECT_EQ(limits.most_left_m, 300);
  EXPECT_EQ(limits.most_right_m, 200);
  EXPECT_EQ(limits.foremost_m, -1000);
  EXPECT_EQ(limits.hindmost_m, -1500);
  EXPECT_EQ(LimitsOf({}, {}).most_left_m, 0);
}

TEST(PlanLegs, TheTurnScenarioHasRampsOfTenSeconds) {
  const std::vector<PathLeg> legs{
      {.length_m = 3000}, {.turn_rad = M_PI, .turn_radius_m = 2000}, {.length_m = 5000}};
  const PathResult result = PlanLegs({0, 0}, M_PI / 2, 1000, 50, legs, TurnLimits());
  ASSERT_TRUE(result.path) << result.reason;
  const Path& path = *result.path;
  ASSERT_EQ(path.pieces().size(), 5u);
  // 50 m/s x 500 m / 2000 m / 1.2 m/s^2 by the acceleration of the outer slot.
  EXPECT_NEAR(path.pieces()[1].length_m / 50, 10.42, 0.01);
  EXPECT_NEAR(path.pieces()[2].start_curvature_per_m, 1.0 / 2000, 1e-12);
  EXPECT_NEAR(path.At(path.end_arc_m()).course_rad, 1.5 * M_PI, 1e-9);
  ExpectSmooth(path, -500, path.end_arc_m() + 500);
  ExpectSlotsWithin(path, TurnLimits(), 0, path.end_arc_m());
}

TEST(PlanLegs, TakesTheRampThatIsAskedForOrSaysWhatItNeeds) {
  const auto plan = [](double ramp_s) {
    return PlanLegs({0, 0}, 0, 1000, 50,
                    {{.length_m = 1000}, {.turn_rad = -M_PI, .turn_radius_m = 2000, .ramp_s = ramp_s}},
                    TurnLimits());
  };
  const PathResult good = plan(12);
  ASSERT_TRUE(good.path) << good.reason;
  EXPECT_NEAR(good.path->pieces()[1].length_m, 600, 1e-6);
  const PathResult bad = plan(8);
  EXPECT_FALSE(bad.path);
  EXPECT_NE(bad.reason.find("leg 2"), std::string::npos) << bad.reason;
  EXPECT_NE(bad.reason.find("10.4"), std::string::npos) << bad.reason;
}

TEST(PlanLegs, ClimbsAndSpeedsUpWithinTheLimits) {
  const std::vector<PathLeg> legs{{.length_m = 4000, .climb_m = 300},
                                  {.turn_rad = 1, .climb_m = -20, .speed_m_s = 55},
                                  {.length_m = 3000, .speed_m_s = 65},
                                  {.turn_rad = -2},
                                  {.turn_rad = 0.01},
                                  {.length_m = 100}};
  const PathResult result = PlanLegs({0, 0}, 3, 1000, 50, legs, TurnLimits());
  ASSERT_TRUE(result.path) << result.reason;
  ExpectSmooth(*result.path, -500, result.path->end_arc_m() + 500);
  ExpectSlotsWithin(*result.path, TurnLimits(), 0, result.path->end_arc_m() + 2000);
  EXPECT_NEAR(result.path->At(1e6).up_m, 1280, 1e-9);
  EXPECT_NEAR(result.path->At(1e6).speed_m_s, 65, 1e-9);
}

TEST(PlanLegs, RefusesWithTheNumberOfTheLegAndWhatWouldHelp) {
  const auto reason = [](const std::vector<PathLeg>& legs) {
    const PathResult result = PlanLegs({0, 0}, 0, 1000, 50, legs, TurnLimits());
    EXPECT_FALSE(result.path);
    return result.reason;
  };
  EXPECT_NE(
      reason({{.length_m = 5000}, {.length_m = 1000, .climb_m = 200}}).find("leg 2: too short for a climb"),
      std::string::npos);
  EXPECT_NE(reason({{.length_m = 100, .speed_m_s = 70}}).find("change of speed"), std::string::npos);
  EXPECT_NE(reason({{.length_m = 100}, {.turn_rad = 1, .turn_radius_m = 800}})
                .find("leg 2: a turn radius of 800 m"),
            std::string::npos);
  EXPECT_NE(reason({{.length_m = 0}}).find("leg 1"), std::string::npos);
  EXPECT_NE(reason({{.length_m = 20000, .speed_m_s = 200}}).find("leg 1"), std::string::npos);
  EXPECT_NE(reason({{.length_m = std::nan("")}}).find("not finite"), std::string::npos);
}

TEST(PlanLegs, TheLastSlotsTurnAtTheSpeedThatTheLeaderHasByThen) {
  // 4 km behind the leader, slots are still in the turn when it flies 70 m/s already: 70 x (1 + 500 / 1600)
  // is too fast.
  const PathLimits limits =
      LimitsOf({}, {{-500, 500, 0}, {-500, -500, 0}, {-4000, 500, 0}, {-4000, -500, 0}});
  const auto plan = [&](double radius_m) {
    return PlanLegs({0, 0}, 0, 1000, 50,
                    {{.length_m = 1000},
                     {.turn_rad = 1.5, .turn_radius_m = radius_m},
                     {.length_m = 3000, .speed_m_s = 70}},
                    limits);
  };
  const PathResult tight = plan(1600);
  EXPECT_FALSE(tight.path);
  EXPECT_NE(tight.reason.find("leg 2: a turn radius of 1,600 m is too tight"), std::string::npos)
      << tight.reason;
  const PathResult wide = plan(0);
  ASSERT_TRUE(wide.path) << wide.reason;
  ExpectSlotsWithin(*wide.path, limits, 0, wide.path->end_arc_m() + 5000);
}

TEST(PlanLegs, NoLegsIsStraightOn) {
  const PathResult result = PlanLegs({1, 2}, 0, 1000, 50, {}, TurnLimits());
  ASSERT_TRUE(result.path);
  EXPECT_EQ(result.path->At(500).position.x(), 501);
}

TEST(PlanWaypoints, CutsTheCornerWithinTheLimits) {
  const std::vector<Waypoint> waypoints{{0, 0, 1000, 50}, {20000, 0, 1000, 50}, {20000, 20000, 1000, 50}};
  const PathResult result = PlanWaypoints(waypoints, false, TurnLimits());
  ASSERT_TRUE(result.path) << result.reason;
  const Path& path = *result.path;
  EXPECT_NEAR(path.At(0).position.norm(), 0, 1e-9);
  EXPECT_NEAR(path.At(0).course_rad, 0, 1e-9);
  ExpectSmooth(path, -1000, path.end_arc_m() + 1000);
  ExpectSlotsWithin(path, TurnLimits(), 0, path.end_arc_m() + 3000);
  // On the second leg, it is on its line.
  const PathPoint later = path.At(30000);
  EXPECT_NEAR(later.position.x(), 20000, 1e-6);
  EXPECT_NEAR(later.course_rad, M_PI / 2, 1e-9);
}

TEST(PlanWaypoints, AnOpenPathEndsInACircle) {
  const PathResult result = PlanWaypoints({{0, 0, 1000, 50}, {9000, 0, 1000, 50}}, false, TurnLimits());
  ASSERT_TRUE(result.path) << result.reason;
  const double radius = *LoiterRadius(TurnLimits(), 50);
  const PathPoint point = result.path->At(50000);
  EXPECT_NEAR(point.curvature_per_m, 1 / radius, 1e-12);
  EXPECT_LT((point.position - result.path->At(50000 + 2 * M_PI * radius).position).norm(), 1e-6);
}

TEST(PlanWaypoints, AClosedPathIsPeriodicInEverything) {
  const std::vector<Waypoint> square{
      {0, 0, 1000, 50}, {12000, 0, 1200, 55}, {12000, 12000, 1100, 60}, {0, 12000, 1000, 50}};
  for (const bool reversed : {false, true}) {
    std::vector<Waypoint> waypoints = square;
    if (reversed) std::reverse(waypoints.begin(), waypoints.end());
    const PathResult result = PlanWaypoints(waypoints, true, TurnLimits());
    ASSERT_TRUE(result.path) << result.reason;
    const Path& path = *result.path;
    const double lap = path.lap_m();
    EXPECT_EQ(path.start_arc_m(), 0);
    EXPECT_NEAR(path.At(0).up_slope, 0, 1e-12);
    EXPECT_NEAR(path.lap_turn_rad(), reversed ? -2 * M_PI : 2 * M_PI, 1e-9);
    for (double arc = 0; arc < lap; arc += 97) {
      const PathPoint now = path.At(arc), later = path.At(arc + 2 * lap);
      ASSERT_LT((now.position - later.position).norm(), 1e-6);
      ASSERT_NEAR(later.course_rad - now.course_rad, 2 * path.lap_turn_rad(), 1e-9);
      ASSERT_NEAR(later.up_m, now.up_m, 1e-7);
      ASSERT_NEAR(later.speed_m_s, now.speed_m_s, 1e-9);
    }
    ExpectSmooth(path, lap - 500, lap + 500);
    ExpectSmooth(path, 0, 2 * lap);
    ExpectSlotsWithin(path, TurnLimits(), 0, 2 * lap);
  }
}

TEST(PlanWaypoints, TightensTurnsWhereTheLegsAreShort) {
  const PathLimits limits = TurnLimits();
  const PathResult wide = PlanWaypoints(
      {{0, 0, 1000, 50}, {20000, 0, 1000, 50}, {20000, 20000, 1000, 50}, {0, 20000, 1000, 50}}, true, limits);
  const PathResult tight = PlanWaypoints(
      {{0, 0, 1000, 50}, {3900, 0, 1000, 50}, {3900, 3900, 1000, 50}, {0, 3900, 1000, 50}}, true, limits);
  ASSERT_TRUE(wide.path) << wide.reason;
  ASSERT_TRUE(tight.path) << tight.reason;
  const auto sharpest = [](const Path& path) {
    double curvature = 0;
    for (const PathPiece& piece : path.pieces())
      curvature = std::max(curvature, std::abs(piece.end_curvature_per_m));
    return curvature;
  };
  EXPECT_GT(sharpest(*tight.path), sharpest(*wide.path) * 1.05);
  ExpectSlotsWithin(*tight.path, limits, 0, 2 * tight.path->lap_m());
}

TEST(PlanWaypoints, RefusesWithTheNumberAndWhatWouldHelp) {
  const auto reason = [](const std::vector<Waypoint>& waypoints, bool closed = false) {
    const PathResult result = PlanWaypoints(waypoints, closed, TurnLimits());
    EXPECT_FALSE(result.path);
    return result.reason;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(reason({}), "at least 2");
  has(reason({{0, 0, 1000, 50}}), "at least 2");
  has(reason({{0, 0, 1000, 50}, {9000, 0, 1000, 50}}, true), "at least 3");
  has(reason({{0, 0, 1000, 50}, {9000, 0, 1000, 50}, {9000, 0, 1000, 50}}), "waypoint 2 to 3): both");
  has(reason({{0, 0, 1000, 50}, {9000, 0, 1000, 50}, {0, 0, 1000, 50}}), "waypoint 2: the path turns back");
  has(reason({{0, 0, 1000, 50}, {1000, 0, 1000, 50}, {1000, 1000, 1000, 50}}), "too short for its turns");
  has(reason({{0, 0, 1000, 50}, {9000, 0, 1000, 50, 500}, {9000, 9000, 1000, 50}}),
      "waypoint 2: a turn radius of 500 m");
  has(reason({{0, 0, 1000, 50}, {3000, 0, 2000, 50}}), "leg 1 (waypoint 1 to 2): too short for a climb");
  has(reason({{0, 0, 1000, 50}, {900, 0, 1000, 75}}),
      "leg 1 (waypoint 1 to 2): too short for the change of speed");
  has(reason({{0, 0, 1000, 50}, {9000, 0, 1000, 20}}), "waypoint 2: 20 m/s");
  has(reason({{0, 0, std::nan(""), 50}, {9000, 0, 1000, 20}}), "not finite");
  PathLimits column = LimitsOf({}, {{-1000, 0, 0}, {-41000, 0, 0}});
  const PathResult loop =
      PlanWaypoints({{0, 0, 1000, 50}, {9000, 0, 1000, 50}, {9000, 9000, 1000, 50}}, true, column);
  has(loop.reason, "the formation with its clearance 40,300 m");
}

TEST(PlanWaypoints, TellsAllThatIsWrongAtOnceAndWhere) {
  const auto problems = [](const std::vector<Waypoint>& waypoints) {
    const PathResult result = PlanWaypoints(waypoints, false, TurnLimits());
    EXPECT_FALSE(result.path);
    EXPECT_FALSE(result.problems.empty());
    EXPECT_EQ(result.reason, result.problems.front().text);
    std::vector<std::pair<size_t, bool>> places;
    for (const PathProblem& problem : result.problems) places.emplace_back(problem.waypoint, problem.on_leg);
    return places;
  };
  using Places = std::vector<std::pair<size_t, bool>>;
  EXPECT_EQ(problems({{0, 0, 1000, 20}, {9000, 0, 1000, 50}, {9000, 9000, 1000, 95}}),
            (Places{{0, false}, {2, false}}));
  EXPECT_EQ(
      problems(
          {{0, 0, 1000, 50}, {9000, 0, 1000, 50, 500}, {9000, 9000, 1000, 50, 600}, {0, 9000, 1000, 50}}),
      (Places{{1, false}, {2, false}}));
  EXPECT_EQ(problems({{0, 0, 1000, 50}, {3000, 0, 2000, 50}, {6000, 0, 3000, 50}, {15000, 0, 3000, 50}}),
            (Places{{0, true}, {1, true}}));
}

TEST(PlanWaypoints, TellsWhereItGoesByEachWaypoint) {
  const std::vector<Waypoint> waypoints{
      {0, 0, 1000, 50}, {12000, 0, 1000, 50}, {12000, 12000, 1000, 50}, {0, 12000, 1000, 50}};
  for (const bool closed : {false, true}) {
    const PathResult result = PlanWaypoints(waypoints, closed, TurnLimits());
    ASSERT_TRUE(result.path) << result.reason;
    ASSERT_EQ(result.waypoint_arcs_m.size(), waypoints.size());
    for (size_t i = 0; i < waypoints.size(); ++i) {
      // Nowhere else on the path is nearer.
      const Eigen::Vector2d waypoint(waypoints[i].east_m, waypoints[i].north_m);
      const auto distance = [&](double arc_m) { return (result.path->At(arc_m).position - waypoint).norm(); };
      const double here = distance(result.waypoint_arcs_m[i]);
      for (double arc = 0; arc < result.path->end_arc_m(); arc += 20) EXPECT_GE(distance(arc), here - 0.01);
    }
  }
}

TEST(PlanWaypoints, RandomListsAreFlownWithinTheLimitsOrRefusedWithAReason) {
  const unsigned seed = 20201;
  std::mt19937 random(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  int planned = 0;
  const int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", trial " + std::to_string(trial));
    std::vector<SlotOffset> slots{{-1000, 0, 0}};
    for (int i = 0; i < trial % 4; ++i) slots.push_back({uniform(-2500, 300), uniform(-600, 600), 0});
    const PathLimits limits = LimitsOf({}, slots);
    std::vector<Waypoint> waypoints;
    const int count = std::uniform_int_distribution(2, 7)(random);
    const double size = uniform(4000, 40000), climb = uniform(0, 300), speed = uniform(35, 75),
                 faster = uniform(0, 10);
    for (int i = 0; i < count; ++i) {
      waypoints.push_back(
          {uniform(0, size), uniform(0, size), 1000 + uniform(0, climb), speed + uniform(0, faster)});
    }
    const bool closed = trial % 2 == 0;
    const PathResult result = PlanWaypoints(waypoints, closed, limits);
    ASSERT_NE(result.path.has_value(), !result.reason.empty());
    if (!result.path) continue;
    ++planned;
    const Path& path = *result.path;
    const double lap = path.lap_m();
    ExpectSmooth(path, path.start_arc_m() - 100, path.end_arc_m() + lap + 1000, 1e-3, 5);
    ExpectSlotsWithin(path, limits, path.start_arc_m() + lap, path.end_arc_m() + lap + 4000, 1.05);
    ASSERT_EQ(Violation(path, limits), "");
    if (testing::Test::HasFatalFailure()) return;
  }
  std::cout << planned << " of " << trials << " lists planned, the others refused, seed " << seed
            << std::endl;
  EXPECT_GT(planned, trials / 4);
}

TEST(Violation, FindsWhatAWiderFormationCannotFly) {
  const PathResult result =
      PlanWaypoints({{0, 0, 1000, 50}, {9000, 0, 1000, 50}, {9000, 9000, 1000, 50}}, true, TurnLimits());
  ASSERT_TRUE(result.path) << result.reason;
  EXPECT_EQ(Violation(*result.path, TurnLimits()), "");
  PathLimits wider = TurnLimits();
  wider.most_left_m = 900;
  EXPECT_NE(Violation(*result.path, wider).find("the slot 900 m to the left"), std::string::npos);
  PathLimits longer = TurnLimits();
  longer.hindmost_m = -60000;
  EXPECT_NE(Violation(*result.path, longer).find("shorter than the formation"), std::string::npos);
}

}  // namespace
}  // namespace skein

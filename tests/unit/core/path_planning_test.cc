#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(PlanLegs, NoLegsIsStraightOn) {
  const PathResult result = PlanLegs({1, 2}, 0, 1000, 50, {}, TurnLimits());
  ASSERT_TRUE(result.path);
  EXPECT_EQ(result.path->At(500).position.x(), 501);
}

}  // namespace
}  // namespace skein

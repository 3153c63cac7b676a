#include <numbers>
#include <stdexcept>

#include "unit/monitor/monitor_fixture.h"

namespace skein::monitor {
namespace {

class MonitorProximity : public testing::MonitorTest {};

TEST_F(MonitorProximity, IsToldForEveryUavOnceASecond) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 3000, 0, 1200);
  fleet_.Add(3, 9000, 0, 1000);
  Start();
  Run(10.5);
  EXPECT_EQ(heard_.proximity.size(), 10u);
  ASSERT_EQ(heard_.proximity.back().vehicles.size(), 3u);
  const auto third = *heard_.Proximity(3);
  EXPECT_EQ(third.nearest_id, 2);
  EXPECT_NEAR(third.nearest_horizontal_m, 6000, 1e-6);
  EXPECT_NEAR(third.nearest_vertical_m, 200, 1e-6);
  EXPECT_EQ(third.level, 0);
  EXPECT_EQ(third.level_with_id, 0);
}

TEST_F(MonitorProximity, CanBeToldTenTimesASecond) {
  fleet_.Add(1, 0, 0, 1000);
  CollisionMonitorOptions options;
  options.rate_hz = 10;
  Start(options);
  Run(5);
  EXPECT_EQ(heard_.proximity.size(), 50u);
  EXPECT_EQ(heard_.proximity.back().sweep, 49);
}

TEST_F(MonitorProximity, OfNobodyIsEmptyAndOfOneHasNoOther) {
  Start();
  Run(3);
  EXPECT_EQ(heard_.proximity.size(), 3u);
  EXPECT_TRUE(heard_.proximity.back().vehicles.empty());
  fleet_.Add(5, 0, 0, 1000);
  Run(3);
  const auto only = *heard_.Proximity(5);
  EXPECT_EQ(only.nearest_id, 0);
  EXPECT_EQ(only.nearest_horizontal_m, -1);
  EXPECT_EQ(only.nearest_vertical_m, -1);
  EXPECT_EQ(only.tau_id, 0);
  EXPECT_EQ(only.tau_s, -1);
}

TEST_F(MonitorProximity, ComparesAllAtOneInstantWhateverTheirDelays) {
  // Both fly north at 50 m/s, 1000 m apart, side by side; the telemetry of one is 0.8 s old.
  fleet_.Add(1, 0, 0, 1000, 50, std::numbers::pi / 2);
  fleet_.Add(2, 1000, 0, 1000, 50, std::numbers::pi / 2).delay_s = 0.8;
  Start();
  Run(10.5);
  EXPECT_NEAR(heard_.Proximity(1)->nearest_horizontal_m, 1000, 1e-6);
}

TEST_F(MonitorProximity, WarnsStrangersOnceAndClearsOnce) {
  // Head-on, 100 m/s together, from 10 km: Tau 55 s at 5.5 km, 25 s at 2.6 km, inside at 0.5 km (95 s), out
  // at 105 s.
  fleet_.Add(1, -5000, 0, 1000, 50, 0);
  fleet_.Add(2, 5000, 0, 1000, 50, std::numbers::pi);
  fleet_.commands = false;
  Start();
  Run(120);
  ASSERT_EQ(heard_.events.size(), 4u);
  const char* codes[] = {"proximity_advisory", "proximity_caution", "proximity_warning", "proximity_cleared"};
  const double earliest[] = {45, 74, 95, 105};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(heard_.events[i].code, codes[i]);
    const double at = bus::ToSeconds(heard_.events[i].utime - bus::SimulatedExecutor::kStart);
    EXPECT_GE(at, earliest[i]);
    EXPECT_LE(at, earliest[i] + (i == 3 ? 6.5 : 2.1));
  }
  EXPECT_EQ(heard_.events[0].severity, event_t::ADVISORY);
  EXPECT_EQ(heard_.events[1].severity, event_t::CAUTION);
  EXPECT_EQ(heard_.events[2].severity, event_t::WARNING);
  EXPECT_EQ(heard_.events[3].severity, event_t::INFO);
  EXPECT_EQ(heard_.events[1].text.substr(0, 24), "UAV1 and UAV2: caution, ");
  EXPECT_NE(heard_.events[1].text.find("Tau 2"), std::string::npos);
}

TEST_F(MonitorProximity, LevelsOfBothNameTheOther) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 400, 0, 1000);
  fleet_.Add(3, 800, 0, 1000);
  Start();
  Run(5);
  EXPECT_EQ(heard_.Proximity(1)->level, 3);
  EXPECT_EQ(heard_.Proximity(1)->level_with_id, 2);
  EXPECT_EQ(heard_.Proximity(2)->level_with_id, 1);
  EXPECT_EQ(heard_.Proximity(3)->level_with_id, 2);
}

TEST_F(MonitorProximity, MembersOfAFormationMayBeClose) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.Add(3, 0, 300, 1000);
  fleet_.formations[4] = {1, 2};
  Start();
  Run(10);
  // 1 and 2 are members; 3 is a stranger to both.
  const auto warnings = heard_.Events("proximity_warning");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].text.substr(0, 13), "UAV1 and UAV3");
  EXPECT_EQ(warnings[1].text.substr(0, 13), "UAV2 and UAV3");
}

TEST_F(MonitorProximity, FormationIsNoFalseAlarmForALateMonitor) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.formations[4] = {1, 2};
  Run(60.3);
  Start();
  Run(20);
  EXPECT_TRUE(heard_.events.empty());
}

TEST_F(MonitorProximity, FormationOfTheScenarioCountsUntilTheControllerSpeaks) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.commands = false;
  CollisionMonitorOptions options;
  options.formations = {{4, {1, 2}, {}}};
  Start(options);
  Run(60);
  EXPECT_TRUE(heard_.events.empty());
  fleet_.commands = true;  // a controller that knows of no formation
  Run(4.5);
  EXPECT_TRUE(heard_.events.empty());
  Run(3);
  EXPECT_EQ(heard_.Events("proximity_warning").size(), 1u);
}

TEST_F(MonitorProximity, FormationOutlivesItsController) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.formations[4] = {1, 2};
  Start();
  Run(20);
  fleet_.commands = false;
  Run(60);
  fleet_.commands = true;
  Run(20);
  EXPECT_TRUE(heard_.Events("proximity_warning").empty());
}

TEST_F(MonitorProximity, MembersOfARemovedFormationAreStrangers) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.formations[4] = {1, 2};
  Start();
  Run(20);
  fleet_.formations.clear();
  Run(7);
  EXPECT_EQ(heard_.Events("proximity_warning").size(), 1u);
}

TEST_F(MonitorProximity, LostUavStaysInAndCautionsByItsUncertainty) {
  // Members 300 m apart: R 150 m and 2 m/s meet that after 75 s.
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  fleet_.formations[4] = {1, 2};
  Start();
  Run(20);
  fleet_.uavs[2].downlink = false;
  Run(70);
  EXPECT_EQ(heard_.Proximity(2)->level, 0);
  EXPECT_EQ(heard_.Proximity(2)->nearest_id, 1);
  EXPECT_NEAR(heard_.Proximity(2)->nearest_horizontal_m, 300, 1e-3);
  Run(10);
  EXPECT_EQ(heard_.Proximity(2)->level, 2);
  EXPECT_EQ(heard_.Events("proximity_caution").size(), 1u);
  Run(200);
  EXPECT_EQ(heard_.Proximity(1)->level, 2);
  EXPECT_TRUE(heard_.Events("proximity_warning").empty());
}

TEST_F(MonitorProximity, TellsTheWorstFirstAndNotAThousandAtOnce) {
  for (int id = 1; id <= 60; ++id) fleet_.Add(id, 100.0 * id, 0, 1000);
  Start();
  Run(4);
  EXPECT_EQ(heard_.Events("proximity_warning").size(), 30u);
  ASSERT_EQ(heard_.Events("more_events").size(), 1u);
  // Pairs within 500 m: 59 + 58 + 57 + 56 = 230.
  EXPECT_EQ(heard_.Events("more_events")[0].text, "and 200 more at the same time");
  for (int id = 1; id <= 60; ++id) EXPECT_EQ(heard_.Proximity(id)->level, 3);
}

TEST_F(MonitorProximity, UavThatLeavesClearsItsPairs) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);
  Start();
  Run(10);
  fleet_.uavs.erase(2);
  Run(3);
  ASSERT_EQ(heard_.Events("proximity_cleared").size(), 1u);
  EXPECT_EQ(heard_.Proximity(1)->level, 0);
}

TEST_F(MonitorProximity, BeginsANewFlightWithoutTheAlertsOfTheOneBeforeAndByItsOwnThresholds) {
  fleet_.Add(1, 0, 0, 1000);
  fleet_.Add(2, 300, 0, 1000);  // inside the cylinder of strangers
  CollisionMonitorOptions options;
  options.find_options = [](const std::string& name) -> std::optional<CollisionMonitorOptions> {
    if (name != "Close") return std::nullopt;
    CollisionMonitorOptions close;
    close.strangers.radius_m = close.strangers.d_mod_m = 100;
    return close;
  };
  Start(options);
  Run(10);
  EXPECT_EQ(heard_.Proximity(1)->level, 3);

  fleet_.scenario = "Close";
  fleet_.start_utime = executor_.Now();
  Run(5);
  EXPECT_EQ(heard_.Proximity(1)->level, 0);
  EXPECT_TRUE(heard_.Events("proximity_cleared").empty()) << "nothing has become better";

  fleet_.scenario = "Unknown";
  fleet_.start_utime = executor_.Now();
  Run(5);
  EXPECT_EQ(heard_.Events("scenario_missing").size(), 1u);
  EXPECT_EQ(heard_.Proximity(1)->level, 3);
}

TEST_F(MonitorProximity, NeedsSensibleOptions) {
  CollisionMonitorOptions options;
  options.rate_hz = 0;
  EXPECT_THROW(Start(options), std::invalid_argument);
  options.rate_hz = 11;
  EXPECT_THROW(Start(options), std::invalid_argument);
  options.rate_hz = 1;
  options.strangers.d_mod_m = 10;
  EXPECT_THROW(Start(options), std::invalid_argument);
}

}  // namespace
}  // namespace skein::monitor

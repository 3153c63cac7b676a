#include "config/scenario.h"

#include <cmath>

#include "scenario_file.h"

namespace skein::config {
namespace {

constexpr double kNorth = M_PI / 2;

Scenario Load(const nlohmann::json& json) {
  const ScenarioFile file(json.dump());
  return LoadScenario(file.path());
}

Scenario LoadPatched(const char* patch) { return Load(ThreeUavs().patch(nlohmann::json::parse(patch))); }

TEST(Scenario, KeepsWhatTheFileSays) {
  const Scenario scenario = Load(ThreeUavs());
  EXPECT_EQ(scenario.name, "Three");
  EXPECT_EQ(scenario.duration_s, 60);
  EXPECT_EQ(scenario.origin.latitude_deg, 40.08);
  EXPECT_EQ(scenario.origin.longitude_deg, 116.58);
  ASSERT_EQ(scenario.vehicles.size(), 3u);
  EXPECT_EQ(scenario.vehicles[0].id, 1);
  EXPECT_EQ(scenario.vehicles[0].callsign, "UAV1");
  EXPECT_EQ(scenario.vehicles[0].start.east_m, 1000);
  EXPECT_EQ(scenario.vehicles[0].start.north_m, 3000);
  EXPECT_EQ(scenario.vehicles[0].start.up_m, 800);
  EXPECT_EQ(scenario.vehicles[0].start.speed_m_s, 60);
  ASSERT_EQ(scenario.formations.size(), 2u);
  EXPECT_EQ(scenario.formations[0].control, "skein");
  EXPECT_EQ(scenario.formations[0].slots[1].vehicle_id, 2);
  EXPECT_EQ(scenario.formations[0].slots[1].offset.left_m, 500);
  EXPECT_EQ(scenario.formations[0].slots[1].offset.up_m, 10);
  EXPECT_FALSE(scenario.formations[0].path);
}

TEST(Scenario, TurnsCompassDegreesIntoCourses) {
  const Scenario scenario = Load(ThreeUavs());
  EXPECT_NEAR(scenario.vehicles[0].start.course_rad, kNorth, 1e-12);
  EXPECT_NEAR(scenario.vehicles[1].start.course_rad, 0, 1e-12);
  EXPECT_NEAR(scenario.formations[0].leader.course_rad, 0, 1e-12);
}

TEST(Scenario, FillsTheSlotsOfANamedShape) {
  const Scenario scenario = LoadPatched(R"([
    {"op": "replace", "path": "/formations/0", "value": {"id": 1, "shape": "column", "spacing_m": 300,
     "lead_m": 800, "vehicles": [2, 1],
     "leader": {"east_m": 0, "north_m": 5000, "up_m": 1000, "speed_m_s": 50, "course_deg": 90}}}])");
  const auto& slots = scenario.formations[0].slots;
  ASSERT_EQ(slots.size(), 2u);
  EXPECT_EQ(slots[0].vehicle_id, 2);
  EXPECT_DOUBLE_EQ(slots[0].offset.forward_m, -800);
  EXPECT_EQ(slots[1].vehicle_id, 1);
  EXPECT_DOUBLE_EQ(slots[1].offset.forward_m, -1100);
}

TEST(Scenario, GivesEveryFormationTheControlOfTheFileUnlessItHasItsOwn) {
  const Scenario scenario = LoadPatched(R"([{"op": "add", "path": "/control", "value": "paper"},
    {"op": "add", "path": "/formations/1/control", "value": "skein"}])");
  EXPECT_EQ(scenario.formations[0].control, "paper");
  EXPECT_EQ(scenario.formations[1].control, "skein");
}

TEST(Scenario, GivesEveryVehicleTheLinkOfTheFileUnlessItHasItsOwn) {
  const Scenario scenario = LoadPatched(R"([
    {"op": "add", "path": "/link", "value": {"up": {"loss": 0.1}, "down": {"delay_s": 0.2}}},
    {"op": "add", "path": "/uplink_loss", "value": "keep"},
    {"op": "add", "path": "/vehicles/1/link", "value": {"up": {"delay_s": 1}}},
    {"op": "add", "path": "/vehicles/1/uplink_loss", "value": "hold"}])");
  EXPECT_EQ(scenario.vehicles[0].uplink.loss, 0.1);
  EXPECT_EQ(scenario.vehicles[0].downlink.delay_s, 0.2);
  EXPECT_EQ(scenario.vehicles[0].uplink_loss, UplinkLoss::kKeepLastCommand);
  EXPECT_EQ(scenario.vehicles[1].uplink.loss, 0.1);
  EXPECT_EQ(scenario.vehicles[1].uplink.delay_s, 1);
  EXPECT_EQ(scenario.vehicles[1].downlink.delay_s, 0.2);
  EXPECT_EQ(scenario.vehicles[1].uplink_loss, UplinkLoss::kHoldLevelAfterOneSecond);
}

TEST(Scenario, ReadsModelsByNameAndInline) {
  const Scenario scenario = LoadPatched(R"([
    {"op": "add", "path": "/models", "value": {"jet": {"gains": {"speed_per_s": 0.05},
                                                       "envelope": {"max_speed_m_s": 150}}}},
    {"op": "add", "path": "/vehicles/0/model", "value": "jet"},
    {"op": "replace", "path": "/vehicles/0/speed_m_s", "value": 140},
    {"op": "add", "path": "/vehicles/1/model", "value": {"gains": {"climb_per_s": 0.2}}}])");
  EXPECT_EQ(scenario.vehicles[0].model.name, "jet");
  EXPECT_EQ(scenario.vehicles[0].model.gains.speed_per_s, 0.05);
  EXPECT_EQ(scenario.vehicles[0].model.gains.course_per_s, 0.1);
  EXPECT_EQ(scenario.vehicles[0].model.envelope.max_speed_m_s, 150);
  EXPECT_EQ(scenario.vehicles[0].model.envelope.min_speed_m_s, 30);
  EXPECT_EQ(scenario.vehicles[1].model.name, "custom");
  EXPECT_EQ(scenario.vehicles[1].model.gains.climb_per_s, 0.2);
  EXPECT_EQ(scenario.vehicles[2].model.name, "default");
  EXPECT_FALSE(scenario.vehicles[2].actual);
}

TEST(Scenario, ScalesTheAutopilotThatTheStationDoesNotKnow) {
  const Scenario scenario = LoadPatched(R"([{"op": "add", "path": "/autopilot_scale", "value": 0.7},
    {"op": "add", "path": "/vehicles/1/autopilot_scale", "value": 1},
    {"op": "add", "path": "/vehicles/2/actual_gains", "value": {"speed_per_s": 0.02}}])");
  ASSERT_TRUE(scenario.vehicles[0].actual);
  EXPECT_DOUBLE_EQ(scenario.vehicles[0].actual->speed_per_s, 0.007);
  EXPECT_DOUBLE_EQ(scenario.vehicles[0].actual->course_per_s, 0.07);
  EXPECT_DOUBLE_EQ(scenario.vehicles[0].model.gains.speed_per_s, 0.01);
  EXPECT_FALSE(scenario.vehicles[1].actual);
  EXPECT_EQ(scenario.vehicles[2].actual->speed_per_s, 0.02);
  EXPECT_EQ(scenario.vehicles[2].actual->course_per_s, 0.1);
}

TEST(Scenario, TakesDModAlongWithAWiderCylinder) {
  const Scenario scenario = LoadPatched(R"([
    {"op": "add", "path": "/formations/0/proximity", "value": {"radius_m": 300, "height_m": 60}},
    {"op": "add", "path": "/strangers", "value": {"radius_m": 800}}])");
  EXPECT_EQ(scenario.formations[0].proximity.radius_m, 300);
  EXPECT_EQ(scenario.formations[0].proximity.d_mod_m, 300);
  EXPECT_EQ(scenario.formations[0].proximity.height_m, 60);
  EXPECT_EQ(scenario.formations[0].proximity.advisory_tau_s, 30);
  EXPECT_EQ(scenario.formations[1].proximity.radius_m, 150);
  EXPECT_EQ(scenario.strangers.radius_m, 800);
  EXPECT_EQ(scenario.strangers.d_mod_m, 800);
  EXPECT_EQ(scenario.strangers.advisory_tau_s, 55);
}

TEST(Scenario, ReadsTheTimelineInOrderOfTime) {
  const Scenario scenario = LoadPatched(R"([
    {"op": "add", "path": "/timeline/-", "value": {"at_s": 5, "cut_link": 1, "for_s": 4, "direction": "up"}},
    {"op": "add", "path": "/timeline/-", "value": {"at_s": 20, "cut_link": 2, "frozen": true}},
    {"op": "add", "path": "/timeline/-", "value": {"at_s": 40, "set_link": 2, "down": {"loss": 0.5}}},
    {"op": "add", "path": "/timeline_repeat_s", "value": 50}])");
  ASSERT_EQ(scenario.timeline.size(), 5u);
  EXPECT_EQ(scenario.timeline_repeat_s, 50);
  const auto& up = std::get<CutLink>(scenario.timeline[0].action);
  EXPECT_EQ(scenario.timeline[0].at_s, 5);
  EXPECT_TRUE(up.uplink);
  EXPECT_FALSE(up.downlink);
  EXPECT_EQ(up.for_s, 4);
  const auto& both = std::get<CutLink>(scenario.timeline[1].action);
  EXPECT_EQ(both.vehicle_id, 3);
  EXPECT_TRUE(both.uplink && both.downlink);
  EXPECT_FALSE(both.for_s);
  EXPECT_TRUE(std::get<CutLink>(scenario.timeline[2].action).frozen);
  EXPECT_EQ(std::get<RestoreLink>(scenario.timeline[3].action).vehicle_id, 3);
  const auto& set = std::get<SetLink>(scenario.timeline[4].action);
  EXPECT_FALSE(set.uplink);
  EXPECT_EQ(set.downlink->loss, 0.5);
}

TEST(Scenario, ReadsLegsWithTurnsToTheRightPositive) {
  const Scenario scenario = LoadPatched(R"([{"op": "add", "path": "/formations/0/path", "value": {"legs": [
    {"straight_m": 3000, "climb_m": 100},
    {"turn_deg": 90, "radius_m": 2000, "ramp_s": 10, "speed_m_s": 55}]}}])");
  ASSERT_TRUE(scenario.formations[0].path);
  const auto& legs = scenario.formations[0].path->legs;
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(legs[0].length_m, 3000);
  EXPECT_EQ(legs[0].climb_m, 100);
  EXPECT_EQ(legs[0].turn_rad, 0);
  EXPECT_NEAR(legs[1].turn_rad, -M_PI / 2, 1e-12);
  EXPECT_EQ(legs[1].turn_radius_m, 2000);
  EXPECT_EQ(legs[1].ramp_s, 10);
  EXPECT_EQ(legs[1].speed_m_s, 55);
}

TEST(Scenario, PutsALeaderThatIsNotGivenAtTheFirstWaypoint) {
  const Scenario scenario = LoadPatched(R"([{"op": "remove", "path": "/formations/0/leader"},
    {"op": "add", "path": "/formations/0/path", "value": {"closed": true, "waypoints": [
     {"east_m": 100, "north_m": 200, "up_m": 900, "speed_m_s": 45, "turn_radius_m": 1500},
     {"east_m": 100, "north_m": 9200, "up_m": 900, "speed_m_s": 45},
     {"east_m": 9100, "north_m": 200, "up_m": 900, "speed_m_s": 45}]}}])");
  EXPECT_TRUE(scenario.formations[0].path->closed);
  EXPECT_EQ(scenario.formations[0].path->waypoints.size(), 3u);
  EXPECT_EQ(scenario.formations[0].path->waypoints[0].turn_radius_m, 1500);
  EXPECT_EQ(scenario.formations[0].leader.east_m, 100);
  EXPECT_EQ(scenario.formations[0].leader.up_m, 900);
  EXPECT_EQ(scenario.formations[0].leader.speed_m_s, 45);
  EXPECT_NEAR(scenario.formations[0].leader.course_rad, kNorth, 1e-12);
}

TEST(Scenario, MayHaveNoVehicles) {
  EXPECT_TRUE(Load({{"name", "Empty"},
                    {"origin", {{"latitude_deg", 0}, {"longitude_deg", 0}}},
                    {"vehicles", nlohmann::json::array()}})
                  .vehicles.empty());
}

nlohmann::json Generated(const char* fleet) {
  return {{"name", "Fleet"},
          {"origin", {{"latitude_deg", 0}, {"longitude_deg", 0}}},
          {"fleet", nlohmann::json::parse(fleet)}};
}

TEST(GeneratedFleet, FliesInSlotInAsManyFormationsAsAsked) {
  const Scenario scenario =
      Load(Generated(R"({"count": 7, "formations": 3, "shape": "column", "spacing_m": 400,
    "columns": 2, "east_step_m": 5000, "north_step_m": 7000, "up_step_m": 100,
    "leader": {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 90}})"));
  ASSERT_EQ(scenario.vehicles.size(), 7u);
  ASSERT_EQ(scenario.formations.size(), 3u);
  EXPECT_EQ(scenario.formations[0].slots.size(), 3u);
  EXPECT_EQ(scenario.formations[1].slots.size(), 2u);
  EXPECT_EQ(scenario.formations[2].slots.size(), 2u);
  EXPECT_EQ(scenario.formations[1].leader.east_m, 5000);
  EXPECT_EQ(scenario.formations[2].leader.east_m, 0);
  EXPECT_EQ(scenario.formations[2].leader.north_m, 7000);
  EXPECT_EQ(scenario.formations[2].leader.up_m, 1200);
  // The second of formation 2: 1000 m and one spacing behind a leader that flies east.
  EXPECT_EQ(scenario.formations[1].slots[1].vehicle_id, 5);
  EXPECT_EQ(scenario.vehicles[4].callsign, "UAV5");
  EXPECT_NEAR(scenario.vehicles[4].start.east_m, 5000 - 1400, 1e-9);
  EXPECT_NEAR(scenario.vehicles[4].start.north_m, 0, 1e-9);
  EXPECT_EQ(scenario.vehicles[4].start.up_m, 1100);
}

TEST(GeneratedFleet, ScattersWithinItsBoundAndAlwaysAlike) {
  const auto json = Generated(R"({"count": 50, "formations": 1, "shape": "column", "scatter_m": 80,
    "scatter_up_m": 5, "seed": 3,
    "leader": {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}})");
  const Scenario scenario = Load(json);
  double widest_m = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    const VehicleState& start = scenario.vehicles[i].start;
    EXPECT_LE(std::abs(start.east_m), 80 + 1e-9);
    EXPECT_LE(std::abs(start.north_m - scenario.formations[0].slots[i].offset.forward_m), 80 + 1e-9);
    EXPECT_LE(std::abs(start.up_m - 1000), 5 + 1e-9);
    widest_m = std::max(widest_m, std::abs(start.east_m));
    EXPECT_EQ(start.east_m, Load(json).vehicles[i].start.east_m);
  }
  EXPECT_GT(widest_m, 60);
}

TEST(GeneratedFleet, MayFlyInNoFormation) {
  const Scenario scenario = Load(Generated(R"({"count": 5, "formations": 0, "columns": 5, "east_step_m": 1000,
    "leader": {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}})"));
  EXPECT_EQ(scenario.vehicles.size(), 5u);
  EXPECT_TRUE(scenario.formations.empty());
  EXPECT_EQ(scenario.vehicles[4].start.east_m, 4000);
}

TEST(GeneratedFleet, MovesThePathWithTheFormation) {
  const Scenario scenario = Load(Generated(R"({"count": 4, "formations": 2, "shape": "column",
    "east_step_m": 5000, "columns": 2,
    "leader": {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 0},
    "path": {"waypoints": [{"east_m": 10, "north_m": 0, "up_m": 900, "speed_m_s": 50},
                           {"east_m": 10, "north_m": 5000, "up_m": 900, "speed_m_s": 50}]}})"));
  EXPECT_EQ(scenario.formations[0].path->waypoints[1].east_m, 10);
  EXPECT_EQ(scenario.formations[1].path->waypoints[1].east_m, 5010);
}

}  // namespace
}  // namespace skein::config

#include "config/scenario.h"
#include "scenario_file.h"

namespace skein::config {
namespace {

TEST(ShippedScenarios, AllLoad) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SKEIN_SOURCE_DIR "/scripts/scenarios")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NO_THROW(LoadScenario(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

/// Why the path of a formation cannot be flown by all of its members, "" when it can.
std::string WhyNot(const Scenario& scenario, const FormationConfig& formation) {
  std::vector<VehicleModel> models;
  std::vector<SlotOffset> slots;
  for (const Slot& slot : formation.slots) {
    for (const VehicleConfig& vehicle : scenario.vehicles) {
      if (vehicle.id == slot.vehicle_id) models.push_back(vehicle.model);
    }
    slots.push_back(slot.offset);
  }
  const PathLimits limits = LimitsOf(models, slots);
  if (!formation.path) return "";
  if (formation.path->legs.empty()) {
    return PlanWaypoints(formation.path->waypoints, formation.path->closed, limits).reason;
  }
  const LeaderConfig& leader = formation.leader;
  return PlanLegs({leader.east_m, leader.north_m}, leader.course_rad, leader.up_m, leader.speed_m_s,
                  formation.path->legs, limits)
      .reason;
}

TEST(ShippedScenarios, HavePathsThatAllCanFly) {
  for (const auto& entry : std::filesystem::directory_iterator(SKEIN_SOURCE_DIR "/scripts/scenarios")) {
    if (entry.path().extension() != ".json") continue;
    const Scenario scenario = LoadScenario(entry.path());
    for (const FormationConfig& formation : scenario.formations) {
      EXPECT_EQ(WhyNot(scenario, formation), "") << entry.path() << ", formation " << formation.id;
    }
  }
}

Scenario Shipped(const std::string& name) {
  return LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/" + name);
}

TEST(ShippedScenarios, FlyControlSkeinButForThePapersTwo) {
  for (const char* name : {"triangle.json", "column.json", "crossing.json", "turn.json", "hundred.json"}) {
    for (const FormationConfig& formation : Shipped(name).formations)
      EXPECT_EQ(formation.control, "skein") << name;
  }
  for (const char* name : {"paper-assembly.json", "paper-link-drop.json"}) {
    for (const FormationConfig& formation : Shipped(name).formations)
      EXPECT_EQ(formation.control, "paper") << name;
  }
}

TEST(ShippedScenarios, HundredHasTenFormationsOfTen) {
  const Scenario scenario = Shipped("hundred.json");
  EXPECT_EQ(scenario.vehicles.size(), 100u);
  ASSERT_EQ(scenario.formations.size(), 10u);
  for (const FormationConfig& formation : scenario.formations) EXPECT_EQ(formation.slots.size(), 10u);
}

TEST(ShippedScenarios, TriangleIsFlownByUav1ToUav3) {
  const Scenario scenario = Shipped("triangle.json");
  ASSERT_EQ(scenario.vehicles.size(), 3u);
  EXPECT_EQ(scenario.vehicles[0].callsign, "UAV1");
  EXPECT_EQ(scenario.vehicles[2].callsign, "UAV3");
  EXPECT_TRUE(scenario.formations.at(0).path && scenario.formations[0].path->closed);
}

}  // namespace
}  // namespace skein::config

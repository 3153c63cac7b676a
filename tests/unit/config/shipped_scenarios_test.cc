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

#include "config/variation.h"

#include <cmath>
#include <set>

#include "scenario_file.h"

namespace skein::config {
namespace {

Scenario Read(const nlohmann::json& vary) {
  nlohmann::json json = ThreeUavs();
  json["vary"] = vary;
  json["timeline"].push_back({{"at_s", 25}, {"cut_link", 1}, {"for_s", 10}});
  return LoadScenario(ScenarioFile(json.dump()).path());
}

const nlohmann::json kVary = nlohmann::json::parse(R"({
    "start": {"vehicles": [1, 2], "east_m": 100, "north_m": 200, "up_m": 30, "speed_m_s": 5, "course_deg": 10},
    "timeline": {"at_s": 15, "for_s": 5},
    "link": {"down": {"delay_s": [0.1, 0.3], "loss": [0, 0.2]}},
    "autopilot_scale": [0.8, 1.2]})");

std::vector<double> Drawn(const Scenario& scenario) {
  std::vector<double> numbers;
  for (const VehicleConfig& vehicle : scenario.vehicles) {
    const VehicleState& start = vehicle.start;
    numbers.insert(numbers.end(), {start.east_m, start.north_m, start.up_m, start.speed_m_s, start.course_rad,
                                   vehicle.downlink.delay_s, vehicle.downlink.loss,
                                   vehicle.actual.value_or(vehicle.model.gains).speed_per_s});
  }
  for (const TimelineEntry& entry : scenario.timeline) numbers.push_back(entry.at_s);
  return numbers;
}

TEST(Variation, IsTheSameForOneSeedAndAnotherForTheNext) {
  const Scenario scenario = Read(kVary);
  std::set<std::vector<double>> drawn;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    EXPECT_EQ(Drawn(Varied(scenario, seed)), Drawn(Varied(scenario, seed)));
    drawn.insert(Drawn(Varied(scenario, seed)));
  }
  EXPECT_EQ(drawn.size(), 100u);
}

TEST(Variation, StaysWithinWhatTheFileSaysAndGoesFarInIt) {
  const Scenario scenario = Read(kVary);
  const VehicleConfig& own = scenario.vehicles[0];
  double farthest_m = 0;
  double greatest_loss = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const Scenario varied = Varied(scenario, seed);
    const VehicleConfig& vehicle = varied.vehicles[0];
    const double off_m = std::abs(vehicle.start.north_m - own.start.north_m);
    EXPECT_LE(off_m, 200);
    EXPECT_LE(std::abs(vehicle.start.east_m - own.start.east_m), 100);
    EXPECT_LE(std::abs(vehicle.start.course_rad - own.start.course_rad), 10 * M_PI / 180);
    EXPECT_GE(vehicle.downlink.delay_s, 0.1);
    EXPECT_LE(vehicle.downlink.delay_s, 0.3);
    EXPECT_EQ(vehicle.downlink.jitter_s, 0);
    EXPECT_EQ(vehicle.uplink.delay_s, 0);
    ASSERT_TRUE(vehicle.actual);
    EXPECT_GE(vehicle.actual->course_per_s, 0.08 - 1e-12);
    EXPECT_LE(vehicle.actual->course_per_s, 0.12 + 1e-12);
    farthest_m = std::max(farthest_m, off_m);
    greatest_loss = std::max(greatest_loss, vehicle.downlink.loss);
  }
  EXPECT_GT(farthest_m, 190);
  EXPECT_GT(greatest_loss, 0.19);
}

TEST(Variation, LeavesAloneWhatItDoesNotName) {
  const Scenario scenario = Read(kVary);
  EXPECT_EQ(Varied(scenario, 7).vehicles[2].start.east_m, scenario.vehicles[2].start.east_m);
  const Scenario plain = LoadScenario(ScenarioFile(ThreeUavs().dump()).path());
  EXPECT_EQ(Drawn(Varied(plain, 7)), Drawn(plain));
  EXPECT_FALSE(Varied(plain, 7).vehicles[0].actual);
}

TEST(Variation, KeepsTheOrderOfWhatHappensToOneUav) {
  const Scenario scenario = Read(kVary);
  std::set<bool> first_cut_first;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::optional<double> cut_s;
    std::optional<double> restored_s;
    std::optional<double> other_s;
    double last_s = 0;
    for (const TimelineEntry& entry : Varied(scenario, seed).timeline) {
      EXPECT_GE(entry.at_s, last_s);
      last_s = entry.at_s;
      const auto* cut = std::get_if<CutLink>(&entry.action);
      if (!cut) {
        restored_s = entry.at_s;
      } else if (cut->vehicle_id == 3) {
        cut_s = entry.at_s;
      } else {
        other_s = entry.at_s;
        EXPECT_GE(*cut->for_s, 5);
        EXPECT_LE(*cut->for_s, 15);
      }
    }
    EXPECT_NEAR(*restored_s - *cut_s, 10, 1e-9);
    EXPECT_GE(*cut_s, 5);
    EXPECT_LE(*cut_s, 35);
    first_cut_first.insert(*cut_s < *other_s);
  }
  EXPECT_EQ(first_cut_first.size(), 2u) << "UAVs 3 and 1 never changed places";
}

TEST(Variation, OfTheShippedScenarioVariesEveryRun) {
  const Scenario scenario = LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/varied-link-drop.json");
  EXPECT_NE(Drawn(Varied(scenario, 1)), Drawn(Varied(scenario, 2)));
}

}  // namespace
}  // namespace skein::config

// The paper's two scenarios over real multicast, beside flight-experiment: the same curves, the same events.

#include "system/live_flight.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "system/flight_log.h"

namespace skein::testing {
namespace {

using nlohmann::json;

json Shipped(const std::string& name) {
  return json::parse(std::ifstream(std::string(SKEIN_SOURCE_DIR) + "/scripts/scenarios/" + name));
}

/// Those of a kind, in order of time: code and vehicle, then when.
std::map<std::string, std::vector<double>> TimesOfEvents(const FlightLog& log, double end_s) {
  std::map<std::string, std::vector<double>> times;
  for (const EventAt& item : log.events) {
    if (item.t_s > 0 && item.t_s <= end_s) {
      times[item.event.code + " of UAV " + std::to_string(item.event.vehicle_id)].push_back(item.t_s);
    }
  }
  return times;
}

class LiveFlightTest : public ::testing::Test {
 protected:
  ~LiveFlightTest() override { std::filesystem::remove_all(folder_); }

  /// Flies both scenarios at the same time, as far as they last, and compares each with the experiment.
  void FlyAndCompare(const std::map<std::string, json>& scenarios) {
    std::map<std::string, std::unique_ptr<LiveFlight>> flights;
    for (const auto& [name, scenario] : scenarios) {
      std::ofstream(File(name + ".json")) << scenario;
      flights[name] = std::make_unique<LiveFlight>(File(name + ".json"), File(name + "-live.lcm"));
    }
    for (const auto& [name, flight] : flights) {
      const double duration_s = scenarios.at(name).at("duration_s");
      ASSERT_TRUE(flight->WaitUntil(duration_s + 1, Seconds(duration_s + 30))) << name;
      EXPECT_TRUE(flight->End()) << name;
    }
    for (const auto& [name, scenario] : scenarios) Compare(name, scenario.at("duration_s"));
  }

 private:
  std::string File(const std::string& name) const { return folder_ + "/" + name; }

  void Compare(const std::string& name, double duration_s) {
    SCOPED_TRACE(name);
    const Finished experiment = RunToEnd(
        {Program("flight-experiment"), File(name + ".json"), "--log", File(name + "-experiment.lcm")},
        Seconds(120));
    ASSERT_EQ(experiment.exit_code, 0) << experiment.output;
    const FlightLog reference = ReadFlightLog(File(name + "-experiment.lcm"));
    const FlightLog live = ReadFlightLog(File(name + "-live.lcm"));

    // The last moments may be missing on either side.
    const double end_s = duration_s - 1;
    ASSERT_FALSE(reference.curves.empty());
    ASSERT_EQ(live.curves.size(), reference.curves.size());
    for (const auto& [id, curve] : reference.curves) {
      const double distance_m = GreatestDistance(curve, live.curves.at(id), end_s);
      EXPECT_LE(distance_m, 10) << "UAV " << id;
      RecordProperty(name + "_uav" + std::to_string(id) + "_greatest_distance_m", std::to_string(distance_m));
    }

    const auto expected = TimesOfEvents(reference, end_s);
    const auto seen = TimesOfEvents(live, end_s);
    for (const auto& [event, times] : expected) {
      ASSERT_TRUE(seen.contains(event)) << event << " at " << times.front() << " s is missing";
      ASSERT_EQ(seen.at(event).size(), times.size()) << event;
      for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(seen.at(event)[i], times[i], 1) << event;
    }
    for (const auto& [event, times] : seen) {
      EXPECT_TRUE(expected.contains(event)) << event << " at " << times.front() << " s happened live only";
    }
  }

  std::string folder_ = FreshFolder("skein-live");
};

TEST_F(LiveFlightTest, AgreesWithTheExperimentForNinetySecondsWithTheLinkDropMovedInto) {
  json assembly = Shipped("paper-assembly.json");
  json link_drop = Shipped("paper-link-drop.json");
  assembly["duration_s"] = 90;
  link_drop["duration_s"] = 90;
  link_drop["timeline"] = {{{"at_s", 30}, {"cut_link", 3}}, {{"at_s", 65}, {"restore_link", 3}}};
  FlyAndCompare({{"assembly", assembly}, {"link-drop", link_drop}});
}

// Seven minutes: scripts/soak runs it.
TEST_F(LiveFlightTest, DISABLED_AgreesWithTheExperimentToTheEnd) {
  FlyAndCompare(
      {{"assembly", Shipped("paper-assembly.json")}, {"link-drop", Shipped("paper-link-drop.json")}});
}

}  // namespace
}  // namespace skein::testing

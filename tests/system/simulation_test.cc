// CMD_SIMULATION with real processes: all of them take the new flight, none of them ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <skein/fleet_roster_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/link_status_t.hpp>
#include <string>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/live_flight.h"
#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
namespace channel = bus::channel;

/// A flight of "two.json", with "four.json" beside it.
class SimulationTest : public ::testing::Test {
 protected:
  SimulationTest() { Write("four", 4); }
  ~SimulationTest() override { std::filesystem::remove_all(folder_); }

  std::string File(const std::string& name) const { return folder_ + "/" + name; }

  /// UAVs abreast, in their slots. Returns the file.
  std::string Write(const std::string& name, int vehicles) {
    std::string members;
    std::string uavs;
    for (int id = 1; id <= vehicles; ++id) {
      const std::string comma = id > 1 ? "," : "";
      const std::string number = std::to_string(id);
      members += comma + R"({"vehicle": )" + number + R"(, "forward_m": -1000, "left_m": )" +
                 std::to_string(-600 * id) + "}";
      uavs += comma + R"({"id": )" + number + R"(, "east_m": )" + std::to_string(600 * id) +
              R"(, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 0})";
    }
    std::ofstream(File(name + ".json"))
        << R"({"name": "Flight of )" << name << R"(", "origin": {"latitude_deg": 47, "longitude_deg": 8},
               "formations": [{"id": 1, "name": "Formation of )"
        << name << R"(", "shape": "custom", "slots": [)" << members << R"(], "leader": {"east_m": 0,
               "north_m": 1000, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}}], "vehicles": [)"
        << uavs << "]}";
    return File(name + ".json");
  }

  Finished Skein(const std::vector<std::string>& words) {
    std::vector<std::string> command{Program("skein"), "--lcm-url", flight_.lcm_url(), "scenario"};
    command.insert(command.end(), words.begin(), words.end());
    return RunToEnd(command);
  }

  bool ControllerFlies(const std::string& formation, std::size_t slots) {
    return Hears<formation_t>(
        flight_.lcm_url(), channel::kFormation,
        [&](const formation_t& message) {
          return message.name == formation && message.slots.size() == slots;
        },
        5s);
  }
  bool MonitorWatches(std::size_t uavs) {
    return Hears<link_status_t>(
        flight_.lcm_url(), channel::kLinkStatus,
        [&](const link_status_t& message) {
          return message.links.size() == uavs &&
                 std::all_of(message.links.begin(), message.links.end(), [](const vehicle_link_t& link) {
                   return link.downlink == link_status_t::LINK_UP && link.uplink == link_status_t::LINK_UP;
                 });
        },
        10s);
  }

  std::string folder_ = FreshFolder("skein-simulation");
  LiveFlight flight_{Write("two", 2), File("flight.lcm")};
};

TEST_F(SimulationTest, AllNodesTakeTheNewFlightAndNoneOfThemEnds) {
  ASSERT_TRUE(ControllerFlies("Formation of two", 2));
  const Finished restarted = Skein({"restart"});
  EXPECT_EQ(restarted.exit_code, 0) << restarted.output;
  EXPECT_NE(restarted.output.find("Flight of two starts anew with 2 UAVs"), std::string::npos)
      << restarted.output;
  EXPECT_TRUE(flight_.WaitUntil(0, 2s));
  EXPECT_TRUE(MonitorWatches(2));

  const Finished loaded = Skein({"load", "four"});
  EXPECT_EQ(loaded.exit_code, 0) << loaded.output;
  EXPECT_NE(loaded.output.find("4 UAVs"), std::string::npos) << loaded.output;
  EXPECT_TRUE(ControllerFlies("Formation of four", 4));
  EXPECT_TRUE(MonitorWatches(4));
  EXPECT_TRUE(flight_.End()) << "all were there to the end";
}

TEST_F(SimulationTest, RefusesGarbageAndFliesOn) {
  for (const std::string name : {"no-such", "../two", "/etc/passwd", "two.json/..", "", " "}) {
    const Finished refused = Skein({"load", name});
    EXPECT_NE(refused.exit_code, 0) << name;
    EXPECT_NE(refused.output, "") << name;
  }
  EXPECT_TRUE(ControllerFlies("Formation of two", 2));
  EXPECT_TRUE(flight_.WaitUntil(1, 5s));
  EXPECT_TRUE(flight_.End());
}

TEST_F(SimulationTest, ANodeThatComesBackFindsTheScenarioThatFliesByItsName) {
  // As it is started again by scripts/run: with the scenario of the beginning.
  const std::string url = FreshLcmUrl();
  Process simulator({Program("fleet-simulator"), "--lcm-url", url, "--scenario", File("four.json")});
  Process controller({Program("formation-controller"), "--lcm-url", url, "--scenario", File("two.json")});
  EXPECT_TRUE(Hears<formation_t>(
      url, channel::kFormation,
      [](const formation_t& message) { return message.name == "Formation of four"; }, 10s))
      << controller.output();
}

}  // namespace
}  // namespace skein::testing

// A flight recorded by lcm-logger and played by lcm-logplayer shows on a second page as it was.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "system/flight_log.h"
#include "system/http.h"
#include "system/live_flight.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

/// What the bridge tells of the UAVs, as soon as all of them are where the log leaves them (or when time is
/// up).
json WaitForVehicles(int port, const FlightLog& log, std::chrono::seconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    json vehicles = json::parse(HttpGet(port, "/api/vehicles").value()).at("vehicles");
    const bool at_end = std::all_of(vehicles.begin(), vehicles.end(), [&](const json& vehicle) {
      return vehicle.at("north_m") == log.curves.at(vehicle.at("id")).back().state.north_m;
    });
    if (at_end || std::chrono::steady_clock::now() > deadline) return vehicles;
  }
}

TEST(Replay, ShowsOnASecondPageTheFlightThatWasRecorded) {
  const std::string folder = FreshFolder("skein-replay");
  const std::string file = folder + "/flight.lcm";
  LiveFlight flight("triangle", file);
  ASSERT_TRUE(flight.WaitUntil(2, 30s));
  const Finished cut =
      RunToEnd({Program("skein"), "--lcm-url", flight.lcm_url(), "link", "cut", "3", "--for", "3"});
  ASSERT_EQ(cut.exit_code, 0) << cut.output;
  ASSERT_TRUE(flight.WaitUntil(10, 30s));
  ASSERT_TRUE(flight.End());
  const FlightLog log = ReadFlightLog(file);
  ASSERT_EQ(log.curves.size(), 3U);

  const int port = FreeTcpPort();
  Process replay({std::string(SKEIN_SOURCE_DIR) + "/scripts/replay", file, "--speed", "5", "--port",
                  std::to_string(port), "--lcm-url", FreshLcmUrl()});
  ASSERT_TRUE(replay.WaitForOutput("That was the end of the log", 60s)) << replay.output();

  // The player has sent the last tick; the page's bridge may still have it before it.
  const json vehicles = WaitForVehicles(port, log, 10s);
  ASSERT_EQ(vehicles.size(), 3U);
  for (const json& vehicle : vehicles) {
    const vehicle_state_t& last = log.curves.at(vehicle.at("id")).back().state;
    EXPECT_DOUBLE_EQ(vehicle.at("east_m"), last.east_m);
    EXPECT_DOUBLE_EQ(vehicle.at("north_m"), last.north_m);
    EXPECT_DOUBLE_EQ(vehicle.at("up_m"), last.up_m);
    EXPECT_TRUE(vehicle.at("flown"));
  }
  const json state = json::parse(HttpGet(port, "/api/state").value());
  EXPECT_EQ(state.at("roster").at("scenario"), "Triangle on a closed path");
  EXPECT_EQ(state.at("formations").size(), 1U);
  EXPECT_EQ(state.at("paths").size(), 1U);
  for (const EventAt& item : log.events) {
    EXPECT_TRUE(std::any_of(state.at("events").begin(), state.at("events").end(), [&](const json& event) {
      return event.at("utime") == item.event.utime && event.at("text") == item.event.text;
    })) << item.event.text;
  }
  EXPECT_TRUE(std::any_of(log.events.begin(), log.events.end(),
                          [](const EventAt& item) { return item.event.code == "link_cut"; }));

  replay.Signal(SIGINT);
  EXPECT_EQ(replay.WaitForEnd(10s), 0) << replay.output();
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skein::testing

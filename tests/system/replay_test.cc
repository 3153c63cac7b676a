// A flight recorded by lcm-logger and played by lcm-logplayer shows on a second page as it was.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <skein/ack_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <string>

#include "bus/channels.h"
#include "system/bus_ear.h"
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

Finished CutLinkOf3(const std::string& lcm_url) {
  return RunToEnd({Program("skein"), "--lcm-url", lcm_url, "link", "cut", "3", "--for", "3"});
}

/// A flight of `end_s` in which the link of UAV3 is cut after two seconds, for three.
void RecordAFlight(const std::string& file, double end_s) {
  LiveFlight flight("triangle", file);
  ASSERT_TRUE(flight.WaitUntil(2, 30s));
  const Finished cut = CutLinkOf3(flight.lcm_url());
  ASSERT_EQ(cut.exit_code, 0) << cut.output;
  ASSERT_TRUE(flight.WaitUntil(end_s, 60s));
  ASSERT_TRUE(flight.End());
}

Process StartReplay(const std::string& file, int port, const std::string& lcm_url,
                    std::vector<std::string> more) {
  std::vector<std::string> command = {std::string(SKEIN_SOURCE_DIR) + "/scripts/replay",
                                      file,
                                      "--port",
                                      std::to_string(port),
                                      "--lcm-url",
                                      lcm_url};
  command.insert(command.end(), more.begin(), more.end());
  return Process(command);
}

TEST(Replay, ShowsOnASecondPageTheFlightThatWasRecorded) {
  const std::string folder = FreshFolder("skein-replay");
  const std::string file = folder + "/flight.lcm";
  RecordAFlight(file, 10);
  const FlightLog log = ReadFlightLog(file);
  ASSERT_EQ(log.curves.size(), 3U);

  const int port = FreeTcpPort();
  Process replay = StartReplay(file, port, FreshLcmUrl(), {"--speed", "5"});
  ASSERT_TRUE(replay.WaitForOutput("That was the end of the recording", 60s)) << replay.output();

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

  EXPECT_EQ(state.at("hello").at("replay"),
            (json{{"kind", "player"}, {"name", "flight.lcm"}, {"speed", 5.0}}));
  const HttpAnswer command =
      HttpPost(port, "/api/command", R"({"channel":"CMD_LINK","body":{"vehicle_id":3,"mode":"silent"}})");
  EXPECT_EQ(command.status, 409);
  EXPECT_EQ(json::parse(command.body).at("reason"), "this is a replay: nothing can be commanded");

  replay.Signal(SIGINT);
  EXPECT_EQ(replay.WaitForEnd(10s), 0) << replay.output();
  std::filesystem::remove_all(folder);
}

TEST(Replay, PlaysCommandsOnlyWhenAsked) {
  const std::string folder = FreshFolder("skein-replay");
  const std::string file = folder + "/flight.lcm";
  RecordAFlight(file, 4);
  // A recording in two parts.
  std::filesystem::copy(file, file + ".01");
  for (const bool asked : {false, true}) {
    const std::string url = FreshLcmUrl();
    Process spy({Program("skein"), "--lcm-url", url, "spy", "--json"});
    Process replay =
        StartReplay(file, FreeTcpPort(), url,
                    asked ? std::vector<std::string>{"--with-commands"} : std::vector<std::string>{});
    ASSERT_TRUE(replay.WaitForOutput("flight.lcm.01\n", 60s)) << replay.output();
    ASSERT_TRUE(replay.WaitForOutput("That was the end of the recording", 60s)) << replay.output();
    replay.Signal(SIGINT);
    EXPECT_EQ(replay.WaitForEnd(10s), 0) << replay.output();
    spy.Signal(SIGINT);
    EXPECT_EQ(spy.WaitForEnd(10s), 0);
    EXPECT_NE(spy.output().find("\"FLEET_STATE\""), std::string::npos) << spy.output();
    EXPECT_EQ(spy.output().find("\"CMD_") != std::string::npos, asked) << spy.output();
    EXPECT_EQ(spy.output().find("\"CMD_LINK\"") != std::string::npos, asked) << spy.output();
  }
  std::filesystem::remove_all(folder);
}

TEST(Replay, RefusesABusOnWhichNodesLiveAndTheLiveOne) {
  const std::string folder = FreshFolder("skein-replay");
  const std::string file = folder + "/flight.lcm";
  LiveFlight flight("triangle", file);
  ASSERT_TRUE(flight.WaitUntil(1, 30s));
  Process replay = StartReplay(file, FreeTcpPort(), flight.lcm_url(), {});
  EXPECT_EQ(replay.WaitForEnd(30s), 2);
  EXPECT_NE(replay.output().find("nodes are alive on"), std::string::npos) << replay.output();
  const auto expect_refused = [&](const std::string& url, const std::string& why) {
    Process live = StartReplay(file, FreeTcpPort(), url, {});
    EXPECT_EQ(live.WaitForEnd(30s), 2) << url;
    EXPECT_NE(live.output().find(why), std::string::npos) << url << ": " << live.output();
  };
  // Another group is no other bus.
  for (const char* url : {"udpm://239.255.76.68:7667?ttl=0", "udpm://"})
    expect_refused(url, "is the live bus");
  // LCM reads 0x1df3 as 7667.
  for (const char* port : {"0x1df3", "07667", "+7667", "7667/"})
    expect_refused("udpm://239.255.76.67:" + std::string(port) + "?ttl=0", "must be a plain number");
  ASSERT_TRUE(flight.End());
  std::filesystem::remove_all(folder);
}

TEST(Replay, ThatIsPlayedOnALiveBusCommandsNobody) {
  const std::string folder = FreshFolder("skein-replay");
  LiveFlight flight("triangle", folder + "/live.lcm");
  ASSERT_TRUE(flight.WaitUntil(1, 30s));
  // A later flight than this one, so that all its sessions are newer.
  const std::string later = folder + "/later.lcm";
  RecordAFlight(later, 5);
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::system_clock::now().time_since_epoch());
  Process player({"lcm-logplayer", "--lcm-url=" + flight.lcm_url(), "--regexp=CMD_.*", later});
  // The simulator of this flight answers; its session is older than anything in the recording.
  EXPECT_TRUE(Hears<ack_t>(
      flight.lcm_url(), bus::channel::kAck,
      [](const ack_t& ack) {
        return !ack.accepted && ack.reason == "meant for another run of fleet-simulator: send it again";
      },
      30s));
  EXPECT_EQ(player.WaitForEnd(30s), 0) << player.output();
  ASSERT_TRUE(Hears<fleet_state_t>(
      flight.lcm_url(), bus::channel::kFleetState, [](const fleet_state_t&) { return true; }, 5s));
  // Its own controller still flies it, and can be asked.
  const Finished cut = CutLinkOf3(flight.lcm_url());
  EXPECT_EQ(cut.exit_code, 0) << cut.output;
  ASSERT_TRUE(flight.End());
  const FlightLog log = ReadFlightLog(folder + "/live.lcm");
  for (const auto& [id, curve] : log.curves) {
    const std::int64_t session = curve.back().state.command_session_id;
    EXPECT_GT(session, 0);
    EXPECT_LT(session, now.count());
    EXPECT_TRUE(std::all_of(curve.begin(), curve.end(),
                            [&](const StateAt& at) {
                              return at.state.command_session_id == session ||
                                     at.state.command_session_id == 0;
                            }))
        << "UAV " << id << " has obeyed another controller";
  }
  for (const EventAt& item : log.events) {
    EXPECT_FALSE(item.event.code == "link_lost" && item.event.vehicle_id != 3) << item.event.text;
  }
  // One cut: the one that was really asked for.
  EXPECT_EQ(std::count_if(log.events.begin(), log.events.end(),
                          [](const EventAt& item) { return item.event.code == "link_cut"; }),
            1);
  std::filesystem::remove_all(folder);
}

TEST(Replay, PlaysEachPartOnceAlsoWhenTheFirstOneIsGone) {
  const std::string folder = FreshFolder("skein-replay");
  // Sync word, number, time, lengths, channel, data.
  const std::string event = std::string("\xED\xA1\xDA\x01", 4) + std::string(15, '\0') + '\1' +
                            std::string("\0\0\0\4\0\0\0\3", 8) + "POSEabc";
  for (const char* part : {"01", "02"}) {
    std::ofstream(folder + "/flight.lcm." + part, std::ios::binary) << event;
  }
  const std::vector<std::vector<std::string>> named = {{"02"}, {"01", "02"}};
  for (const auto& parts : named) {
    std::vector<std::string> more;
    for (const std::string& part : parts) more.push_back(folder + "/flight.lcm." + part);
    Process replay = StartReplay(folder + "/flight.lcm", FreeTcpPort(), FreshLcmUrl(), more);
    ASSERT_TRUE(replay.WaitForOutput("That was the end of the recording", 60s)) << replay.output();
    replay.Signal(SIGINT);
    EXPECT_EQ(replay.WaitForEnd(10s), 0) << replay.output();
    std::string played;
    for (std::size_t at = 0; (at = replay.output().find("flight.lcm.0", at)) != std::string::npos; ++at) {
      played += replay.output().substr(at, 13) + ' ';
    }
    EXPECT_EQ(played, "flight.lcm.01 flight.lcm.02 ") << replay.output();
  }
  std::filesystem::remove_all(folder);
}

TEST(Replay, SaysWhatIsWrongWithAFile) {
  const std::string folder = FreshFolder("skein-replay");
  const std::string script = std::string(SKEIN_SOURCE_DIR) + "/scripts/replay";
  std::ofstream(folder + "/empty.lcm");
  std::ofstream(folder + "/text.lcm") << "This is no recording.";
  const std::vector<std::pair<std::string, std::string>> wrong = {{folder, "is a folder"},
                                                                  {folder + "/none.lcm", "no such file"},
                                                                  {folder + "/empty.lcm", "is empty"},
                                                                  {folder + "/text.lcm", "is no LCM log"}};
  for (const auto& [file, reason] : wrong) {
    const Finished replay = RunToEnd({script, file, "--lcm-url", FreshLcmUrl()});
    EXPECT_EQ(replay.exit_code, 2) << replay.output;
    EXPECT_NE(replay.output.find(reason), std::string::npos) << replay.output;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skein::testing

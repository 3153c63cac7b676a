#include "cli/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/command_inbox.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr bus::Utime kStart = bus::SimulatedExecutor::kStart;

/// The command line against a stand-in for the nodes, over memq on a simulated clock.
class CommandLineTest : public testing::Test {
 protected:
  /// Runs `skein WORDS`. Returns what it prints; throws what it throws.
  std::string Skein(std::vector<std::string> words) {
    CommandLine command_line;
    std::reverse(words.begin(), words.end());
    command_line.app().parse(words);
    bus::Bus bus(transport_, "skein", executor_);
    Station station(bus, [this](bus::Utime duration) {
      executor_.RunFor(duration);
      return !interrupted_;
    });
    std::ostringstream out;
    command_line.command()(station, out);
    return out.str();
  }

  /// What a command that fails says.
  std::string FailureOf(const std::vector<std::string>& words) {
    try {
      Skein(words);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "did not fail";
  }

  template <typename Command>
  void Obey(const std::string& channel, std::vector<Command>& got) {
    inbox_.Obey<Command>(channel, [this, &got](const Command& command) {
      got.push_back(command);
      return refusal_.empty() ? bus::Answer::Accepted() : bus::Answer::Refused(refusal_);
    });
  }

  void StartFleet() {
    executor_.Every(bus::kSecond, [this] {
      fleet_roster_t roster;
      roster.utime = executor_.Now();
      roster.start_utime = kStart;
      roster.origin_latitude_deg = 40;
      roster.origin_longitude_deg = 116;
      for (int id = 1; id <= 3; ++id) {
        vehicle_info_t info;
        info.id = id;
        info.callsign = "UAV" + std::to_string(id);
        info.model = "default";
        info.k_speed_per_s = info.k_course_per_s = info.k_climb_per_s = 0.1;
        info.max_speed_m_s = 90;
        info.max_acceleration_m_s2 = info.max_course_rate_rad_s = info.max_climb_rad =
            info.max_climb_rate_rad_s = 1;
        roster.vehicles.push_back(info);
      }
      bus::PublishChunks(node_, channel::kFleetRoster, roster);
    });
  }

  void StartFormation(int id) {
    executor_.Every(bus::kSecond, [this, id] {
      formation_t formation;
      formation.utime = executor_.Now();
      formation.formation_id = id;
      formation.name = "Alpha";
      formation.control = "skein";
      formation.shape = "column";
      formation.spacing_m = 400;
      formation.lead_m = 1000;
      formation.radius_m = formation.d_mod_m = 150;
      formation.height_m = 50;
      formation.advisory_tau_s = 30;
      formation.caution_tau_s = 15;
      formation.slots.resize(2);
      formation.slots[0].vehicle_id = 2;
      formation.slots[1].vehicle_id = 1;
      formation.num_slots = 2;
      node_.Publish(channel::kFormation, formation);
    });
  }

  std::string Write(const std::string& name, const std::string& text) {
    const auto path = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(path) << text;
    return path;
  }

  std::shared_ptr<lcm::LCM> transport_ = bus::MakeTransport("memq://").lcm;
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus node_{transport_, "stand-in", executor_};
  bus::CommandInbox inbox_{node_};
  std::string refusal_;
  bool interrupted_ = false;
};

class LinkTest : public CommandLineTest {
 protected:
  void SetUp() override { Obey(channel::kCmdLink, got_); }
  std::vector<link_command_t> got_;
};

TEST_F(LinkTest, CutsBothDirectionsForATime) {
  EXPECT_EQ(Skein({"link", "cut", "3", "--for", "35"}), "cut link of 3 for 35 s\n");
  ASSERT_EQ(got_.size(), 1U);
  EXPECT_EQ(got_[0].vehicle_id, 3);
  EXPECT_TRUE(got_[0].uplink);
  EXPECT_TRUE(got_[0].downlink);
  EXPECT_EQ(got_[0].mode, link_command_t::MODE_SILENT);
  EXPECT_EQ(got_[0].duration_s, 35);
  EXPECT_EQ(got_[0].start_utime, 0);
}

TEST_F(LinkTest, CutsOneDirectionOfSeveralUavs) {
  StartFleet();
  EXPECT_EQ(Skein({"link", "cut", "uav1", "UAV3", "--down-only", "--frozen"}),
            "froze downlink of UAV1\nfroze downlink of UAV3\n");
  ASSERT_EQ(got_.size(), 2U);
  EXPECT_EQ(got_[1].vehicle_id, 3);
  EXPECT_FALSE(got_[0].uplink);
  EXPECT_TRUE(got_[0].downlink);
  EXPECT_EQ(got_[0].mode, link_command_t::MODE_FROZEN);
  EXPECT_EQ(got_[1].request_id, got_[0].request_id + 1);
}

TEST_F(LinkTest, RestoresAtATimeOfTheScenario) {
  StartFleet();
  Skein({"link", "restore", "3", "--at", "235.5"});
  ASSERT_EQ(got_.size(), 1U);
  EXPECT_EQ(got_[0].mode, link_command_t::MODE_RESTORED);
  EXPECT_EQ(got_[0].start_utime, kStart + 235'500'000);
}

TEST_F(LinkTest, RefusesATimeThatHasPassed) {
  StartFleet();
  executor_.RunFor(20 * bus::kSecond);
  EXPECT_EQ(FailureOf({"link", "cut", "3", "--at", "5"}), "5 s of the scenario have passed: it is 21 s");
  EXPECT_TRUE(got_.empty());
}

TEST_F(LinkTest, SaysWhoThereIsWhenACallsignIsUnknown) {
  StartFleet();
  EXPECT_EQ(FailureOf({"link", "cut", "UAV9"}),
            "there is no UAV \"UAV9\" in this fleet; there are UAV1, UAV2, UAV3");
}

TEST_F(LinkTest, SaysThatNoFleetIsThere) {
  EXPECT_EQ(FailureOf({"link", "cut", "UAV3"}),
            "no fleet was heard for 3 s: is fleet-simulator running, and on this LCM URL?");
}

TEST_F(LinkTest, PassesOnWhyItWasRefused) {
  refusal_ = "there is no UAV 9";
  EXPECT_EQ(FailureOf({"link", "cut", "9"}), "refused: there is no UAV 9");
}

TEST_F(CommandLineTest, SaysWhoShouldHaveAnsweredAfterThreeSeconds) {
  EXPECT_EQ(FailureOf({"link", "cut", "3"}),
            "nobody answered CMD_LINK for 3 s: is fleet-simulator running, and on this LCM URL?");
  EXPECT_EQ(executor_.Now() - kStart, 3 * bus::kSecond);
}

TEST_F(CommandLineTest, SendsARequestAgainUntilItIsAnswered) {
  std::vector<std::int64_t> request_ids;
  node_.Subscribe<link_command_t>(channel::kCmdLink, [&](const link_command_t& command) {
    request_ids.push_back(command.request_id);
    if (request_ids.size() < 3) return;  // the first two are lost
    ack_t ack;
    ack.node = "fleet-simulator";
    ack.command_channel = channel::kCmdLink;
    ack.session_id = command.to_session_id;
    ack.command_session_id = command.session_id;
    ack.command_request_id = command.request_id;
    ack.accepted = 1;
    node_.Publish(channel::kAck, ack);
  });
  Skein({"link", "cut", "3"});
  EXPECT_EQ(request_ids, (std::vector<std::int64_t>{1, 1, 1}));
}

TEST_F(CommandLineTest, DoesNotTakeAnAnswerToSomebodyElse) {
  node_.Subscribe<link_command_t>(channel::kCmdLink, [&](const link_command_t& command) {
    ack_t ack;
    ack.node = "fleet-simulator";
    ack.command_channel = channel::kCmdLink;
    ack.session_id = command.to_session_id;
    ack.command_session_id = command.session_id + 1;
    ack.command_request_id = command.request_id;
    ack.accepted = 1;
    node_.Publish(channel::kAck, ack);
  });
  EXPECT_NE(FailureOf({"link", "cut", "3"}).find("nobody answered"), std::string::npos);
}

TEST_F(CommandLineTest, SwitchesPayloads) {
  std::vector<payload_command_t> got;
  Obey(channel::kCmdPayload, got);
  EXPECT_EQ(Skein({"payload", "on", "1", "2"}), "payload on: 1 2\n");
  Skein({"payload", "off", "2"});
  ASSERT_EQ(got.size(), 2U);
  EXPECT_TRUE(got[0].on);
  EXPECT_EQ(got[0].vehicle_ids, (std::vector<int>{1, 2}));
  EXPECT_FALSE(got[1].on);
}

TEST_F(CommandLineTest, HoldsResumesAndRemovesAFormation) {
  std::vector<formation_command_t> got;
  Obey(channel::kCmdFormation, got);
  EXPECT_EQ(Skein({"formation", "hold", "7"}), "formation 7 holds\n");
  Skein({"formation", "resume", "7"});
  Skein({"formation", "remove", "7"});
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(got[0].action, formation_command_t::ACTION_HOLD);
  EXPECT_EQ(got[1].action, formation_command_t::ACTION_RESUME);
  EXPECT_EQ(got[2].action, formation_command_t::ACTION_REMOVE);
  EXPECT_EQ(got[2].formation.formation_id, 7);
}

TEST_F(CommandLineTest, AppliesAFormationFromAFile) {
  std::vector<formation_command_t> got;
  Obey(channel::kCmdFormation, got);
  const auto file =
      Write("apply.json", R"({"id": 2, "shape": "column", "spacing_m": 600, "lead_m": 900, "vehicles": [3, 1],
                                            "control": "paper", "proximity": {"radius_m": 120}})");
  EXPECT_EQ(Skein({"formation", "apply", file}), "formation 2 applied\n");
  ASSERT_EQ(got.size(), 1U);
  const formation_t& formation = got[0].formation;
  EXPECT_EQ(formation.name, "Formation 2");
  EXPECT_EQ(formation.control, "paper");
  EXPECT_EQ(formation.radius_m, 120);
  ASSERT_EQ(formation.slots.size(), 2U);
  EXPECT_EQ(formation.slots[0].vehicle_id, 3);
  EXPECT_EQ(formation.slots[0].forward_m, -900);
  EXPECT_EQ(formation.slots[1].forward_m, -1500);
}

TEST_F(CommandLineTest, RefusesAFormationFileWithTheReason) {
  const auto file = Write("bad.json", R"({"id": 2, "shape": "colum", "vehicles": [3]})");
  try {
    Skein({"formation", "apply", file});
    FAIL() << "not refused";
  } catch (const config::ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("/shape: "), std::string::npos) << error.what();
  }
}

TEST_F(CommandLineTest, ShowsAFormationAsAFileThatItAppliesAgain) {
  StartFormation(4);
  const std::string shown = Skein({"formation", "show", "4"});
  const auto json = nlohmann::json::parse(shown);
  EXPECT_EQ(json["vehicles"], (std::vector<int>{2, 1}));
  std::vector<formation_command_t> got;
  Obey(channel::kCmdFormation, got);
  Skein({"formation", "apply", Write("shown.json", shown)});
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].formation.spacing_m, 400);
  EXPECT_EQ(got[0].formation.radius_m, 150);
  EXPECT_EQ(got[0].formation.slots[1].vehicle_id, 1);
}

TEST_F(CommandLineTest, NamesTheFormationsWhenThereIsNoSuchOne) {
  StartFormation(4);
  StartFormation(5);
  EXPECT_EQ(FailureOf({"formation", "show", "6"}), "there is no formation 6; there are 4, 5");
  EXPECT_EQ(FailureOf({"formation", "show", "--json"}), "there is more than one formation (4, 5): say which");
}

TEST_F(CommandLineTest, UploadsAPathToTheOnlyFormation) {
  StartFleet();
  StartFormation(4);
  std::vector<path_command_t> got;
  Obey(channel::kCmdPath, got);
  const auto file = Write("path.geojson", R"({"type": "Feature", "properties": {"speed_m_s": 50}, "geometry":
      {"type": "LineString", "coordinates": [[116, 40, 1000], [116, 40.05, 1000], [116.05, 40.05, 1100]]}})");
  EXPECT_EQ(Skein({"path", "upload", file, "--closed"}), "formation 4 flies 3 waypoints, round and round\n");
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].formation_id, 4);
  EXPECT_TRUE(got[0].closed);
  ASSERT_EQ(got[0].num_waypoints, 3);
  EXPECT_EQ(got[0].waypoints[2].up_m, 1100);
  EXPECT_NEAR(got[0].waypoints[1].north_m, 5552, 2);
}

TEST_F(CommandLineTest, ShowsTheStatusOfEveryUavOfTheRoster) {
  StartFleet();
  executor_.Every(50'000, [this] {
    fleet_state_t state;
    state.utime = executor_.Now();
    state.tick = state.utime / 50'000;
    state.vehicles.resize(1);
    state.vehicles[0].id = 2;
    state.vehicles[0].up_m = 1000;
    state.vehicles[0].speed_m_s = 50;
    state.vehicles[0].payload_on = 1;  // course 0: east
    bus::PublishChunks(node_, channel::kFleetState, state);
  });
  executor_.Every(bus::kSecond, [this] {
    proximity_t proximity;
    proximity.utime = executor_.Now();
    proximity.sweep = proximity.utime / bus::kSecond;
    proximity.vehicles.resize(1);
    auto& near = proximity.vehicles[0];
    near.id = 2;
    near.level = 2;
    near.nearest_id = near.tau_id = 3;
    near.nearest_horizontal_m = 707.1;
    near.nearest_vertical_m = 12;
    near.tau_s = 21.4;
    bus::PublishChunks(node_, channel::kProximity, proximity);
  });
  const auto json = nlohmann::json::parse(Skein({"status", "--json"}));
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json[1]["callsign"], "UAV2");
  EXPECT_EQ(json[1]["level"], 2);
  EXPECT_EQ(json[1]["course_deg"], 90);
  EXPECT_EQ(json[1]["payload_on"], true);
  EXPECT_TRUE(json[0]["speed_m_s"].is_null());
  EXPECT_TRUE(json[1]["downlink"].is_null());

  const std::string table = Skein({"status"});
  EXPECT_NE(table.find("UAV2  caution"), std::string::npos) << table;
  EXPECT_NE(table.find("UAV3   707    12  UAV3 21    1000        50.0     090       on"), std::string::npos)
      << table;
}

TEST_F(CommandLineTest, ListsAlarmsAndActsOnThem) {
  std::vector<alarm_command_t> got;
  Obey(channel::kCmdAlarm, got);
  EXPECT_EQ(FailureOf({"alarms"}),
            "no alarms were heard for 2.5 s: is collision-monitor running, and on this LCM URL?");
  executor_.Every(bus::kSecond, [this, sequence = std::int64_t{0}]() mutable {
    alarm_list_t list;
    list.utime = executor_.Now();
    list.session_id = 5;
    list.sequence = sequence++;
    list.newest_id = 12;
    list.num_not_listed = 4;
    for (const int id : {12, 9}) {
      alarm_t& alarm = list.alarms.emplace_back();
      alarm.id = id;
      alarm.condition = "link:3";
      alarm.severity = event_t::WARNING;
      alarm.state = id == 12 ? alarm_t::UNACKNOWLEDGED : alarm_t::OVER;
      alarm.text = "link of UAV3 lost";
      alarm.raised_utime = list.utime - 7 * bus::kSecond;
    }
    bus::PublishChunks(node_, channel::kAlarms, list);
  });
  EXPECT_EQ(Skein({"alarms"}),
            "id  severity  state           raised   alarm\n"
            "12  WARNING   UNACKNOWLEDGED  7 s ago  link of UAV3 lost\n"
            "and 4 less urgent ones\n");
  EXPECT_EQ(nlohmann::json::parse(Skein({"alarms", "--json", "--history"})).size(), 2U);
  EXPECT_EQ(Skein({"alarm", "ack", "12"}), "alarm 12 acknowledged\n");
  EXPECT_EQ(Skein({"alarm", "ack", "all"}), "all alarms acknowledged\n");
  EXPECT_EQ(Skein({"alarm", "shelve", "12", "9", "--for", "90"}), "alarms 12 9 shelved for 90 s\n");
  EXPECT_EQ(Skein({"alarm", "unshelve", "12"}), "alarm 12 unshelved\n");
  EXPECT_EQ(FailureOf({"alarm", "ack", "UAV3"}),
            "alarms have numbers, as `skein alarms` lists them, not \"UAV3\"");
  ASSERT_EQ(got.size(), 4U);
  EXPECT_EQ(got[0].alarm_session_id, 5);
  EXPECT_EQ(got[0].alarm_ids, std::vector<std::int64_t>{12});
  EXPECT_EQ(got[1].all_up_to_id, 12);
  EXPECT_EQ(got[2].duration_s, 90);
  EXPECT_EQ(got[3].action, alarm_command_t::ACTION_UNSHELVE);
}

TEST(CommandLineUsage, RefusesWhatMakesNoSense) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"link"},
                                             {"link", "cut"},
                                             {"link", "cut", "3", "--for", "-1"},
                                             {"link", "cut", "3", "--up-only", "--down-only"},
                                             {"link", "mend", "3"},
                                             {"formation", "hold", "zero"},
                                             {"formation", "apply", "/no/such/file.json"},
                                             {"path", "upload"},
                                             {"status", "--what"}}) {
    CommandLine command_line;
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    EXPECT_THROW(command_line.app().parse(reversed), CLI::ParseError) << testing::PrintToString(words);
  }
}

}  // namespace
}  // namespace skein::cli

#include "cli/drops.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <skein/ack_t.hpp>
#include <skein/link_command_t.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/command_inbox.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "cli/command_line.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr bus::Utime kStart = bus::SimulatedExecutor::kStart;

/// `skein drops` against a stand-in for the simulator and a monitor that finds cuts after 4 s, over memq on a
/// simulated clock.
class DropsTest : public testing::Test {
 protected:
  void StartFleet(int vehicles) {
    executor_.Every(bus::kSecond, [this, vehicles] {
      fleet_roster_t roster;
      roster.utime = executor_.Now();
      roster.start_utime = kStart;
      for (int id = 1; id <= vehicles; ++id) {
        vehicle_info_t& info = roster.vehicles.emplace_back();
        info.id = id;
        info.callsign = "UAV" + std::to_string(id);
        info.model = "default";
        info.k_speed_per_s = info.k_course_per_s = info.k_climb_per_s = 0.1;
        info.max_speed_m_s = 90;
        info.max_acceleration_m_s2 = info.max_course_rate_rad_s = info.max_climb_rad =
            info.max_climb_rate_rad_s = 1;
      }
      bus::PublishChunks(node_, channel::kFleetRoster, roster);
    });
    executor_.Every(bus::kSecond / 4, [this, vehicles] {
      link_status_t status;
      status.utime = executor_.Now();
      status.sequence = sequence_++;
      for (int id = 1; id <= vehicles; ++id) {
        vehicle_link_t& link = status.links.emplace_back();
        link = vehicle_link_t{};
        link.id = id;
        link.uplink = link.downlink = link_status_t::LINK_UP;
        if (IsLost(id)) link.downlink = link_status_t::LINK_LOST;
      }
      bus::PublishChunks(node_, channel::kLinkStatus, status);
    });
  }

  /// Takes CMD_LINK as the simulator does.
  void Obey() {
    inbox_.Obey<link_command_t>(channel::kCmdLink, [this](const link_command_t& command) {
      got_.push_back(command);
      return bus::Answer::Accepted();
    });
  }

  /// Runs `skein drops WORDS`. Returns how it failed; "" when it did not.
  std::string Drops(std::vector<std::string> words) {
    words.insert(words.begin(), "drops");
    CommandLine command_line;
    std::reverse(words.begin(), words.end());
    command_line.app().parse(words);
    bus::Bus bus(transport_, "skein", executor_);
    Station station(bus, [this](bus::Utime duration) {
      executor_.RunFor(duration);
      return executor_.Now() < interrupt_at_ || std::exchange(interrupted_, true);
    });
    try {
      command_line.command()(station, out_);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }

  std::string Write(const std::string& name, const std::string& text) {
    const auto path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }

  /// A program that notes in a file with what it was called, and then does `more`.
  std::string Hook(const std::string& more) {
    const std::string path = Write("hook", "#!/bin/sh\necho $1 $2 >>" + Calls() + "\n" + more + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  std::string Calls() const { return folder_ / "calls"; }
  std::string ReadCalls() const {
    std::ifstream stream(Calls());
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  DropsTest() { std::filesystem::create_directories(folder_); }
  ~DropsTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("skein-drops-" + std::to_string(getpid()));
  std::shared_ptr<lcm::LCM> transport_ = bus::MakeTransport("memq://").lcm;
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus node_{transport_, "stand-in", executor_};
  bus::CommandInbox inbox_{node_};
  std::vector<link_command_t> got_;
  bus::Utime interrupt_at_ = kStart + 10'000 * bus::kSecond;
  bool interrupted_ = false;
  std::int64_t sequence_ = 0;  ///< of LINK_STATUS
  std::ostringstream out_;

 private:
  bool IsLost(int id) const {
    const bus::Utime now = executor_.Now();
    return std::any_of(got_.begin(), got_.end(), [&](const link_command_t& command) {
      const bus::Utime end = command.start_utime + bus::ToUtime(command.duration_s);
      return command.vehicle_id == id && command.mode == link_command_t::MODE_SILENT &&
             now >= command.start_utime + 4 * bus::kSecond && now < end;
    });
  }
};

TEST_F(DropsTest, CommandsAWholeFleetBeforeTheDropBegins) {
  StartFleet(300);
  Obey();
  EXPECT_EQ(Drops({"all", "--for", "6", "--json"}), "");
  ASSERT_EQ(got_.size(), 300U);
  for (const link_command_t& command : got_) {
    EXPECT_EQ(command.start_utime, got_[0].start_utime);
    EXPECT_LT(command.utime, command.start_utime) << command.vehicle_id;
  }
  EXPECT_EQ(nlohmann::json::parse(out_.str())["summary"]["found"], 300);
}

TEST_F(DropsTest, CommandsUavsThatAreNamedOneByOneBeforeTheirDropsBegin) {
  StartFleet(200);
  Obey();
  std::string list = "at_s,uav,for_s\n";
  for (int id = 1; id <= 200; ++id) list += "0," + std::to_string(id) + ",6\n";
  EXPECT_EQ(Drops({"--list", Write("list.csv", list), "--from-now"}), "");
  ASSERT_EQ(got_.size(), 200U);
  for (const link_command_t& command : got_) EXPECT_LT(command.utime, command.start_utime);
}

TEST_F(DropsTest, SaysWhenNotAllLinksAreAsTheyWere) {
  StartFleet(1);
  inbox_.Obey<link_command_t>(channel::kCmdLink, [](const link_command_t& command) {
    if (command.mode == link_command_t::MODE_RESTORED) return bus::Answer::Refused("out of order");
    return bus::Answer::Accepted();
  });
  interrupt_at_ = kStart + 10 * bus::kSecond;
  testing::internal::CaptureStderr();
  EXPECT_EQ(Drops({"1", "--for", "300", "--repeat", "400", "--limit", "100"}),
            "not all links are as they were");
  EXPECT_NE(testing::internal::GetCapturedStderr().find("UAV1: its link could not be restored: out of order"),
            std::string::npos);
}

TEST_F(DropsTest, SendsAgainWhatWasLostOnTheWay) {
  StartFleet(100);
  std::int64_t last = 0;
  std::set<std::int64_t> lost;
  std::set<std::int64_t> obeyed;
  // Of one the command is lost, of one the answer, once each.
  node_.Subscribe<link_command_t>(channel::kCmdLink, [&](const link_command_t& command) {
    const std::int64_t id = command.request_id;
    if (id == 30 && lost.insert(id).second) return;
    ack_t ack;
    ack.utime = executor_.Now();
    ack.node = "fleet-simulator";
    ack.command_channel = channel::kCmdLink;
    ack.session_id = command.to_session_id;
    ack.command_session_id = command.session_id;
    ack.command_request_id = command.request_id;
    ack.accepted = id > last || obeyed.contains(id);
    ack.reason = ack.accepted ? "" : "too old";
    last = std::max(last, id);
    if (ack.accepted && obeyed.insert(id).second) got_.push_back(command);
    if (id == 40 && lost.insert(id).second) return;
    node_.Publish(channel::kAck, ack);
  });
  EXPECT_EQ(Drops({"all", "--for", "6"}), "");
  std::map<int, int> commands;
  for (const link_command_t& command : got_) ++commands[command.vehicle_id];
  EXPECT_EQ(commands.size(), 100U);
  EXPECT_EQ(got_.size(), 100U) << "twice for a time would be for good";
  for (const link_command_t& command : got_) EXPECT_LT(command.utime, command.start_utime);
}

TEST_F(DropsTest, RestoresEveryLinkWhenStopped) {
  StartFleet(3);
  Obey();
  interrupt_at_ = kStart + 20 * bus::kSecond;
  testing::internal::CaptureStderr();
  EXPECT_EQ(Drops({"all", "--random", "--rate", "600", "--shortest", "300", "--longest", "300", "--json"}),
            "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(got_.size(), 6U);
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(got_[i].mode, link_command_t::MODE_RESTORED);
  EXPECT_EQ(nlohmann::json::parse(out_.str())["summary"]["found"], 3);
}

TEST_F(DropsTest, ReportsWhatWasFoundUntilItFailed) {
  StartFleet(2);
  inbox_.Obey<link_command_t>(channel::kCmdLink, [this](const link_command_t& command) {
    if (command.vehicle_id == 2) return bus::Answer::Refused("there is no UAV 2");
    got_.push_back(command);
    return bus::Answer::Accepted();
  });
  const std::string list = Write("list.csv", "at_s,uav,for_s\n1,1,8\n20,2,8\n");
  EXPECT_EQ(Drops({"--list", list, "--from-now", "--json"}), "UAV2: refused: there is no UAV 2");
  EXPECT_EQ(nlohmann::json::parse(out_.str())["summary"]["found"], 1);
}

TEST_F(DropsTest, LetsAHookBeginAtOnce) {
  StartFleet(2);
  const std::string list = Write("list.csv", "at_s,uav,for_s\n0,none,2\n");
  EXPECT_EQ(Drops({"--list", list, "--from-now", "--hook", Hook("")}), "");
  EXPECT_EQ(Drops({"1", "--for", "2", "--hook", Hook("")}), "");
  EXPECT_EQ(ReadCalls(), "begin 1\nend 1\nbegin 1\nend 1\n");
}

TEST_F(DropsTest, LetsAHookBeginAgainWhatTheEndOfAnotherDropLifted) {
  StartFleet(2);
  const std::string list =
      Write("list.csv", "at_s,uav,for_s\n0,none,4\n0,UAV2,4.5\n1,2,2\n1,none,2\n2,1,2.5\n");
  EXPECT_EQ(Drops({"--list", list, "--from-now", "--hook", Hook("")}), "");
  // Whatever the UAV is called by; nobody's link is no UAV's, and UAV 1's no other one's.
  EXPECT_EQ(ReadCalls(),
            "begin 1\nbegin 2\nbegin 3\nbegin 4\nbegin 5\n"
            "end 3\nbegin 2\nend 4\nbegin 1\nend 1\nend 2\nend 5\n");
}

TEST_F(DropsTest, EndsEveryDropOfAHookThatFailsAndSaysWhyItStopped) {
  StartFleet(2);
  const std::string list = Write("list.csv", "at_s,uav,for_s\n0,none,50\n1,none,50\n2,none,50\n");
  testing::internal::CaptureStderr();
  const std::string failure = Drops(
      {"--list", list, "--from-now", "--json", "--hook", Hook("[ $1$2 != begin3 ] && [ $1$2 != end1 ]")});
  EXPECT_NE(failure.find("begin failed"), std::string::npos) << failure;
  EXPECT_NE(testing::internal::GetCapturedStderr().find("end failed"), std::string::npos);
  EXPECT_EQ(ReadCalls(), "begin 1\nbegin 2\nbegin 3\nend 1\nend 2\nend 3\n");
  EXPECT_EQ(nlohmann::json::parse(out_.str())["summary"]["drops"], 0) << "of nobody's link";
}

TEST_F(DropsTest, RefusesToRepeatAListBeforeItsEnd) {
  StartFleet(2);
  Obey();
  const std::string list = Write("list.csv", "at_s,uav,for_s\n10,1,8\n40,2,8\n");
  EXPECT_THROW(Drops({"--list", list, "--repeat", "30"}), config::ConfigError);
  interrupt_at_ = kStart + 100 * bus::kSecond;
  EXPECT_EQ(Drops({"--list", list, "--repeat", "31"}), "");
  // At 10, 40, 41, 71, 72 and, announced only, 102 s.
  EXPECT_EQ(got_.size(), 5U);
}

TEST_F(DropsTest, RefusesATimeOfTheScenarioThatHasPassed) {
  StartFleet(2);
  Obey();
  executor_.RunFor(20 * bus::kSecond);
  EXPECT_EQ(Drops({"1", "--at", "5"}), "5 s of the scenario have passed: it is 21 s");
}

TEST_F(DropsTest, ChecksAListWithoutAFleet) {
  CommandLine command_line;
  std::vector<std::string> words{
      "--check", Write("list.csv", "at_s,uav,for_s,delay_s\r\n\r\n20,all,8\r\n10.5,none,7,0.3\r\n"), "--list",
      "drops"};
  command_line.app().parse(words);
  EXPECT_EQ(command_line.offline_command()(out_), 0);
  EXPECT_EQ(out_.str(), "at_s,uav,direction,for_s,loss,delay_s\n10.5,none,both,7,0,0.3\n20,all,both,8,1,0\n");
}

}  // namespace
}  // namespace skein::cli

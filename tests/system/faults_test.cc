// Processes that die, stop, or are started twice: what was is found again, and nobody works against anybody.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <skein/alarm_list_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <skein/link_status_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/faulty_flight.h"
#include "system/process.h"
#include "system/small_disk.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

class OnlyOneTest : public FaultsTest, public ::testing::WithParamInterface<std::string> {
 protected:
  /// Listens for so long, from before `begin`. What is heard of the node under test comes from one process
  /// alone: its heartbeats, each tick and the commands to it once and in order, alarms of one session.
  void ExpectOneAlone(
      Seconds duration, const std::function<void()>& begin = [] {}) const {
    std::set<std::int64_t> beating;
    std::set<std::int64_t> commanding;
    std::set<std::int64_t> alarming;
    std::int64_t last_tick = -1;
    std::int64_t last_answered = -1;
    int ticks_again = 0;
    int answered_again = 0;
    const bus::Transport transport = bus::MakeTransport(url_);
    bus::LiveExecutor executor(transport.lcm);
    bus::Bus ear(transport.lcm, "system-test", executor);
    ear.Subscribe<heartbeat_t>(bus::channel::kHeartbeat, [&](const heartbeat_t& heartbeat) {
      if (heartbeat.heartbeat_node == GetParam()) beating.insert(heartbeat.session_id);
    });
    ear.Subscribe<fleet_state_t>(bus::channel::kFleetState, [&](const fleet_state_t& state) {
      ticks_again += state.tick <= last_tick;
      last_tick = state.tick;
    });
    ear.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [&](const fleet_command_t& command) {
      commanding.insert(command.session_id);
      answered_again += command.state_tick <= last_answered;
      last_answered = command.state_tick;
    });
    ear.Subscribe<alarm_list_t>(bus::channel::kAlarms,
                                [&](const alarm_list_t& list) { alarming.insert(list.session_id); });
    begin();
    executor.At(executor.Now() + bus::ToUtime(duration.count()), [&] { executor.Stop(); });
    executor.Run();
    EXPECT_EQ(beating.size(), 1U);
    EXPECT_EQ(commanding.size(), 1U);
    EXPECT_EQ(alarming.size(), 1U);
    EXPECT_EQ(ticks_again, 0) << "of two simulators";
    EXPECT_EQ(answered_again, 0) << "of two controllers";
  }
  std::int64_t Session() const {
    std::int64_t session = 0;
    Hears<heartbeat_t>(
        url_, bus::channel::kHeartbeat,
        [&](const heartbeat_t& heartbeat) {
          if (heartbeat.heartbeat_node == GetParam()) session = heartbeat.session_id;
          return session != 0;
        },
        5s);
    return session;
  }
};

TEST_P(OnlyOneTest, TheSecondStaysBackAndTakesOverWhenTheFirstDies) {
  StartAll();
  const auto second = Start(GetParam());
  ASSERT_TRUE(second->WaitForOutput("stands by", 10s)) << second->output();
  ExpectOneAlone(3s);
  const std::int64_t first_session = Session();
  nodes_[GetParam()]->Signal(SIGKILL);
  ASSERT_TRUE(second->WaitForOutput("takes over", 5s)) << second->output();
  EXPECT_TRUE(Hears<heartbeat_t>(
      url_, bus::channel::kHeartbeat,
      [&](const heartbeat_t& heartbeat) {
        return heartbeat.heartbeat_node == GetParam() && heartbeat.session_id > first_session;
      },
      5s));
  ExpectOneAlone(3s);
}

TEST_P(OnlyOneTest, OfTwoThatAreStartedAtOnceOneAloneFlies) {
  for (int round = 0; round < 3; ++round) {
    SCOPED_TRACE("round " + std::to_string(round + 1));
    std::unique_ptr<Process> one;
    std::unique_ptr<Process> other;
    ExpectOneAlone(6s, [&] {
      for (const std::string& node : kNodes) {
        if (node != GetParam()) nodes_[node] = Start(node);
      }
      one = Start(GetParam());
      other = Start(GetParam());
    });
    const auto stands_by = [](Process& process) { return process.WaitForOutput("stands by", 0s); };
    EXPECT_NE(stands_by(*one), stands_by(*other)) << one->output() << "\n" << other->output();
    EXPECT_EQ(one->WaitForEnd(0s), std::nullopt) << one->output();
    EXPECT_EQ(other->WaitForEnd(0s), std::nullopt) << other->output();
    nodes_.clear();
  }
}

TEST_P(OnlyOneTest, AFirstThatWasStoppedMeanwhileEndsWhenItGoesOn) {
  StartAll();
  const auto second = Start(GetParam());
  ASSERT_TRUE(second->WaitForOutput("stands by", 10s)) << second->output();
  nodes_[GetParam()]->Signal(SIGSTOP);
  ASSERT_TRUE(second->WaitForOutput("takes over", 10s)) << second->output();
  ASSERT_TRUE(HearsHeartbeat(url_, GetParam()));
  // No UAV goes back to an older controller.
  std::map<int, std::int64_t> newest;
  nodes_[GetParam()]->Signal(SIGCONT);
  EXPECT_FALSE(Hears<fleet_state_t>(
      url_, bus::channel::kFleetState,
      [&](const fleet_state_t& state) {
        return std::any_of(state.vehicles.begin(), state.vehicles.end(), [&](const vehicle_state_t& uav) {
          std::int64_t& session = newest[uav.id];
          if (uav.command_session_id < session) return true;
          session = uav.command_session_id;
          return false;
        });
      },
      3s));
  EXPECT_EQ(nodes_[GetParam()]->WaitForEnd(5s), 1);
  EXPECT_NE(nodes_[GetParam()]->output().find("has taken over"), std::string::npos)
      << nodes_[GetParam()]->output();
}

INSTANTIATE_TEST_SUITE_P(Skein, OnlyOneTest, ::testing::ValuesIn(kNodes), [](const auto& named) {
  std::string name = named.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_F(FaultsTest, AKilledSimulatorGoesOnWithTheFlight) {
  StartAll();
  Skein({"link", "cut", "3", "--for", "60"});
  ASSERT_TRUE(Hears<fleet_state_t>(
      url_, bus::channel::kFleetState, [](const fleet_state_t& state) { return state.tick > 60; }, 15s));
  const fleet_state_t before = NextState();
  Restart("fleet-simulator");
  const fleet_state_t after = NextState();
  EXPECT_EQ(after.session_id, before.session_id) << "the same flight";
  const double gap_s = bus::ToSeconds(after.utime - before.utime);
  EXPECT_GT(gap_s, 0);
  EXPECT_LT(gap_s, 2);
  EXPECT_EQ(after.tick - before.tick, std::llround(gap_s * 20));
  ASSERT_EQ(after.vehicles.size(), 2u) << "the link that was cut is cut";
  for (std::size_t i = 0; i < after.vehicles.size(); ++i) {
    const vehicle_state_t& one = before.vehicles[i];
    const vehicle_state_t& other = after.vehicles[i];
    const double flown_m =
        std::hypot(other.east_m - one.east_m, other.north_m - one.north_m, other.up_m - one.up_m);
    EXPECT_NEAR(flown_m, one.speed_m_s * gap_s, 5 + 5 * gap_s) << "UAV" << one.id;
  }
  EXPECT_TRUE(HoldsSlots(2000, 10s)) << "the controller goes on, too";
}

TEST_F(FaultsTest, AKilledMonitorKeepsWhatWasAcknowledged) {
  StartAll();
  Skein({"link", "cut", "3", "--for", "60"});
  std::int64_t id = 0;
  ASSERT_TRUE(HearsAlarm(
      "link:3",
      [&](const alarm_t& alarm) {
        id = alarm.id;
        return alarm.state == alarm_t::UNACKNOWLEDGED && alarm.severity == event_t::WARNING;
      },
      10s));
  Skein({"alarm", "ack", "all"});
  Restart("collision-monitor");
  const auto as_before = [&](const alarm_t& alarm) {
    return alarm.id == id && alarm.state == alarm_t::ACKNOWLEDGED;
  };
  EXPECT_TRUE(HearsAlarm("link:3", as_before, 5s));
  // Also when the monitor has found out by itself that the link is lost.
  const auto is_another = [&](const alarm_t& alarm) {
    return alarm.state != alarm_t::OVER && !as_before(alarm);
  };
  EXPECT_FALSE(HearsAlarm("link:3", is_another, 13s));
}

TEST_F(FaultsTest, AMonitorKilledRightAfterACutTellsTheLossWithinFiveSeconds) {
  StartAll();
  double slowest_s = 0;
  for (int round = 0; round < 3; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    // A monitor that has just begun has a link in order to hear first.
    ASSERT_TRUE(Hears<link_status_t>(
        url_, bus::channel::kLinkStatus,
        [](const link_status_t& status) {
          return std::any_of(status.links.begin(), status.links.end(), [](const vehicle_link_t& link) {
            return link.id == 3 && link.downlink == link_status_t::LINK_UP &&
                   link.uplink == link_status_t::LINK_UP;
          });
        },
        20s));
    std::optional<Process> cut;
    bus::Utime last_heard = 0;
    ASSERT_TRUE(Hears<fleet_state_t>(
        url_, bus::channel::kFleetState,
        [&](const fleet_state_t& state) {
          if (!cut) {
            cut.emplace(std::vector<std::string>{Program("skein"), "--lcm-url", url_, "link", "cut", "3",
                                                 "--for", "8"},
                        environment_);
          }
          const bool heard = std::any_of(state.vehicles.begin(), state.vehicles.end(),
                                         [](const vehicle_state_t& uav) { return uav.id == 3; });
          if (heard) last_heard = state.utime;
          return !heard;
        },
        10s));
    Restart("collision-monitor");
    bus::Utime told = 0;
    ASSERT_TRUE(Hears<event_t>(
        url_, bus::channel::kEvent,
        [&](const event_t& event) {
          told = event.utime;
          return event.code == "link_lost" && event.vehicle_id == 3;
        },
        10s));
    EXPECT_LE(bus::ToSeconds(told - last_heard), 5);
    EXPECT_GE(bus::ToSeconds(told - last_heard), 3) << "that was a guess";
    slowest_s = std::max(slowest_s, bus::ToSeconds(told - last_heard));
    EXPECT_EQ(cut->WaitForEnd(10s), 0) << cut->output();
  }
  std::cout << "told " << slowest_s << " s after it was last heard, at most\n";
}

TEST_F(FaultsTest, WhenTheSimulatorIsGoneThatIsToldWithinFiveSeconds) {
  StartAll();
  nodes_["fleet-simulator"]->Signal(SIGKILL);
  EXPECT_TRUE(HearsAlarm(
      "fleet_silent", [](const alarm_t&) { return true; }, 5s));
  EXPECT_TRUE(Hears<link_status_t>(
      url_, bus::channel::kLinkStatus,
      [](const link_status_t& status) {
        return std::all_of(status.links.begin(), status.links.end(), [](const vehicle_link_t& link) {
          return link.downlink == link_status_t::LINK_LOST;
        });
      },
      3s));
  // Nobody climbs for it: it is one alarm about the fleet, and none about a UAV's link.
  EXPECT_FALSE(HearsAlarm(
      "link:1", [](const alarm_t&) { return true; }, 4s));
  // Nor when it is back: all are heard again at once.
  nodes_["fleet-simulator"] = Start("fleet-simulator");
  EXPECT_FALSE(Hears<formation_status_t>(
      url_, bus::channel::kFormationStatus,
      [](const formation_status_t& status) {
        return status.avoidance_up_m != 0 || status.avoidance_target_m != 0;
      },
      15s));
  EXPECT_EQ(NextState().vehicles.size(), 3U);
}

TEST_F(FaultsTest, TwoFleetsOnOneNetworkKeepApartByTheirPorts) {
  StartAll();
  auto first = std::move(nodes_);
  const std::string first_url = url_;
  const std::string first_folder = std::exchange(folder_, FreshFolder("skein-faults"));
  url_ = FreshLcmUrl();
  StartAll();
  Skein({"formation", "hold", "1"});
  EXPECT_FALSE(Hears<formation_status_t>(
      first_url, bus::channel::kFormationStatus,
      [](const formation_status_t& status) { return status.mode == formation_status_t::MODE_HOLDING; }, 2s))
      << "the other fleet holds, too";
  for (const std::string& url : {first_url, url_}) {
    std::map<std::string, std::set<std::int64_t>> sessions;
    Hears<heartbeat_t>(
        url, bus::channel::kHeartbeat,
        [&](const heartbeat_t& heartbeat) {
          sessions[heartbeat.heartbeat_node].insert(heartbeat.session_id);
          return false;
        },
        3s);
    EXPECT_EQ(sessions.size(), kNodes.size()) << "somebody stands by, or is not heard";
    for (const auto& [node, ids] : sessions) EXPECT_EQ(ids.size(), 1U) << node;
  }
  first.clear();
  std::filesystem::remove_all(first_folder);
}

TEST_F(FaultsTest, AFullDiskEndsNoFlightAndIsToldOnce) {
  const SmallDisk disk(folder_, "64k");
  if (disk.refused() != 0) GTEST_SKIP() << "a small disk cannot be mounted: " << strerror(disk.refused());
  const std::string ballast = folder_ + "/ballast";
  std::ofstream(ballast) << std::string(100'000, '.');
  scenario_ = "turn";  // in formation from the start
  StartAll();
  for (const char* node : {"fleet-simulator", "formation-controller"}) {
    EXPECT_TRUE(nodes_[node]->WaitForOutput("state_not_saved", 10s)) << nodes_[node]->output();
  }
  EXPECT_TRUE(HoldsSlots(20, 10s));
  Skein({"formation", "hold", "1"});
  Skein({"formation", "resume", "1"});
  for (const auto& [node, process] : nodes_) {
    const std::string output = process->output();
    const std::size_t first = output.find("state_not_saved");
    EXPECT_EQ(output.find("state_not_saved", first + 1), std::string::npos) << node << ": " << output;
  }
  // With room again, it is kept again.
  std::filesystem::remove(ballast);
  const std::string state = folder_ + "/formation-controller";
  Skein({"formation", "hold", "1"});
  EXPECT_TRUE(std::filesystem::exists(state)) << "a hold that was promised is not on the disk";
  Restart("formation-controller");
  EXPECT_TRUE(Hears<formation_status_t>(
      url_, bus::channel::kFormationStatus,
      [](const formation_status_t& status) { return status.mode == formation_status_t::MODE_HOLDING; }, 10s));
}

}  // namespace
}  // namespace skein::testing

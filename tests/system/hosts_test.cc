// Simulator, station and operator on three hosts: over a bad network, and one that falls apart.
//
// SKEIN_HOSTS_SECONDS: for how long the network is bad, and how long it is apart (default: 15).

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/link_status_t.hpp>
#include <string>
#include <thread>
#include <utility>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/live_executor.h"
#include "bus/transport.h"
#include "system/bus_ear.h"
#include "system/fake_time.h"
#include "system/hosts.h"
#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string kUrl = "udpm://239.255.76.67:7667?ttl=1";

Seconds Duration() {
  const char* seconds = std::getenv("SKEIN_HOSTS_SECONDS");
  return Seconds(seconds != nullptr ? std::stod(seconds) : 15);
}

/// What an operator's host has heard for a time.
struct Heard {
  int statuses = 0;
  double worst_slot_m = 0;
  double worst_climb_m = 0;                ///< to avoid somebody
  std::map<std::string, int> link_states;  ///< how often told
};

class HostsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "network namespaces need root";
    hosts_ = std::make_unique<Hosts>(std::vector<std::string>{"sim", "station", "operator"});
    Start("sim", "fleet-simulator", {"--scenario", scenario_});
    Start("station", "formation-controller", {"--scenario", scenario_});
    Start("station", "collision-monitor", {"--scenario", scenario_});
    ASSERT_TRUE(HoldsSlots(20, 30s));
    ASSERT_TRUE(LinksAre(link_status_t::LINK_UP, 30s));
  }
  void TearDown() override {
    for (const auto& [name, process] : processes_) {
      EXPECT_EQ(process->WaitForEnd(0s), std::nullopt) << name << " has ended: " << process->output();
    }
    processes_.clear();
  }

  void Start(const std::string& host, const std::string& program, std::vector<std::string> options) {
    const Hosts::Stay stay = hosts_->On(host);
    options.insert(options.begin(), {Program(program), "--lcm-url", kUrl});
    processes_[program] = std::make_unique<Process>(options, environments_[host]);
  }
  bool HoldsSlots(double within_m, Seconds timeout) const {
    const Hosts::Stay stay = hosts_->On("operator");
    return Hears<formation_status_t>(
        kUrl, bus::channel::kFormationStatus,
        [&](const formation_status_t& status) { return !status.slots.empty() && Worst(status) <= within_m; },
        timeout);
  }
  /// Whether all links are in that state at some moment within `timeout`: up both ways, or lost downwards
  /// (what became of the uplink cannot be known then).
  bool LinksAre(std::int8_t state, Seconds timeout) const {
    const Hosts::Stay stay = hosts_->On("operator");
    return Hears<link_status_t>(
        kUrl, bus::channel::kLinkStatus,
        [&](const link_status_t& status) {
          return !status.links.empty() && std::ranges::all_of(status.links, [&](const vehicle_link_t& link) {
            return link.downlink == state && (link.uplink == state || state == link_status_t::LINK_LOST);
          });
        },
        timeout);
  }
  Heard Listen(Seconds duration) const {
    const Hosts::Stay stay = hosts_->On("operator");
    const bus::Transport transport = bus::MakeTransport(kUrl);
    bus::LiveExecutor executor(transport.lcm);
    bus::Bus ear(transport.lcm, "system-test", executor);
    Heard heard;
    ear.Subscribe<formation_status_t>(bus::channel::kFormationStatus, [&](const formation_status_t& status) {
      ++heard.statuses;
      heard.worst_slot_m = std::max(heard.worst_slot_m, Worst(status));
      heard.worst_climb_m = std::max(heard.worst_climb_m, std::abs(status.avoidance_up_m));
    });
    ear.Subscribe<link_status_t>(bus::channel::kLinkStatus, [&](const link_status_t& status) {
      for (const vehicle_link_t& link : status.links) {
        for (const std::int8_t state : {link.downlink, link.uplink}) ++heard.link_states[kStates.at(state)];
      }
    });
    executor.At(executor.Now() + bus::ToUtime(duration.count()), [&] { executor.Stop(); });
    executor.Run();
    return heard;
  }
  static double Worst(const formation_status_t& status) {
    double worst_m = 0;
    for (const slot_status_t& slot : status.slots)
      worst_m = std::max(worst_m, std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m));
    return worst_m;
  }

  const std::map<int, std::string> kStates{{link_status_t::LINK_UP, "up"},
                                           {link_status_t::LINK_LATE, "late"},
                                           {link_status_t::LINK_LOST, "lost"},
                                           {link_status_t::LINK_UNKNOWN, "unknown"}};
  std::string scenario_ = "turn";
  std::map<std::string, std::map<std::string, std::string>>
      environments_;  ///< added to that of programs on a host
  std::unique_ptr<Hosts> hosts_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
};

/// On a path that turns from the start on.
class TurningHostsTest : public HostsTest {
 protected:
  TurningHostsTest() { scenario_ = SKEIN_SOURCE_DIR "/tests/system/octagon.json"; }

  /// What UAVs are like by the simulator's host, until `is_it` says so of all of them.
  bool UavsAre(const std::function<bool(const vehicle_state_t& before, const vehicle_state_t& now)>& is_it,
               Seconds timeout) const {
    const Hosts::Stay stay = hosts_->On("sim");
    std::map<int, vehicle_state_t> before;
    return Hears<fleet_state_t>(
        kUrl, bus::channel::kFleetState,
        [&](const fleet_state_t& state) {
          std::size_t those = 0;
          for (const vehicle_state_t& uav : state.vehicles) {
            const auto [was, first] = before.try_emplace(uav.id, uav);
            those += !first && is_it(was->second, uav);
            was->second = uav;
          }
          return those == 3;
        },
        timeout);
  }
  bool AllTurn(Seconds timeout) const {
    return UavsAre(
        [](const vehicle_state_t& before, const vehicle_state_t& now) {
          return std::abs(now.course_rad - before.course_rad) >
                 0.02 * bus::ToSeconds(now.utime - before.utime);
        },
        timeout);
  }
  struct Answers {
    int ticks = 0;
    int late = 0;  ///< later than a tick, or never
    double latest_ms = 0;
  };
  /// How soon the controller answers the ticks that get through to its host.
  Answers ListenAtStation(Seconds duration) const {
    const Hosts::Stay stay = hosts_->On("station");
    const bus::Transport transport = bus::MakeTransport(kUrl);
    bus::LiveExecutor executor(transport.lcm);
    bus::Bus ear(transport.lcm, "system-test", executor);
    std::map<std::int64_t, bus::Utime> open;
    std::int64_t newest = 0;
    Answers answers;
    ear.Subscribe<fleet_state_t>(bus::channel::kFleetState, [&](const fleet_state_t& state) {
      // One that was overtaken is not answered.
      if (state.tick <= std::exchange(newest, std::max(newest, state.tick))) return;
      open[state.tick] = executor.Now();
      ++answers.ticks;
    });
    ear.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [&](const fleet_command_t& command) {
      const auto tick = open.find(command.state_tick);
      if (tick == open.end()) return;
      const double after_ms = 1e3 * bus::ToSeconds(executor.Now() - tick->second);
      answers.latest_ms = std::max(answers.latest_ms, after_ms);
      answers.late += after_ms > 50;
      open.erase(tick);
    });
    executor.At(executor.Now() + bus::ToUtime(duration.count()), [&] { executor.Stop(); });
    executor.Run();
    answers.late += static_cast<int>(open.size()) - static_cast<int>(open.contains(newest));
    return answers;
  }
};

TEST_F(TurningHostsTest, FlyInFormationOverABadNetwork) {
  hosts_->SetWire(R"({"loss": 0.1, "delay_s": 0.2, "jitter_s": 0.05, "duplicate": 0.02})");
  ASSERT_TRUE(AllTurn(30s));
  Answers answers;
  std::thread at_station([&] { answers = ListenAtStation(Duration()); });
  Heard heard = Listen(Duration());
  at_station.join();
  std::cout << "10% loss, 200 ms +- 50 ms, 2% doubled, for " << Duration().count() << " s: slots within "
            << heard.worst_slot_m << " m; links told up " << heard.link_states["up"] << ", late "
            << heard.link_states["late"] << ", lost " << heard.link_states["lost"] << " times; of "
            << answers.ticks << " ticks answered late " << answers.late << ", at most after "
            << answers.latest_ms << " ms\n";
  EXPECT_GT(heard.statuses, 0);
  EXPECT_LE(heard.worst_slot_m, 20);
  EXPECT_GT(heard.link_states["up"], 0);
  EXPECT_EQ(heard.link_states["lost"], 0);
  EXPECT_GT(answers.ticks, 10 * Duration().count());
  EXPECT_EQ(answers.late, 0);
}

TEST_F(HostsTest, FindEachOtherAgainWhenTheNetworkWasApart) {
  hosts_->SetWire(R"({"apart": ["to-sim"]})");
  const auto cut = Clock::now();
  EXPECT_TRUE(LinksAre(link_status_t::LINK_LOST, 8s));
  const Seconds found = Clock::now() - cut;
  EXPECT_LE(found.count(), 5);
  Listen(Duration() - (Clock::now() - cut));
  hosts_->SetWire("{}");
  const auto healed = Clock::now();
  EXPECT_TRUE(LinksAre(link_status_t::LINK_UP, 10s));
  const Seconds up = Clock::now() - healed;
  EXPECT_TRUE(HoldsSlots(20, 300s));
  std::cout << "apart for " << Duration().count() << " s: all links told lost after " << found.count()
            << " s; whole again: up after " << up.count() << " s, in formation within 20 m after "
            << Seconds(Clock::now() - healed).count() << " s\n";
}

/// What comes back, comes back by itself: nobody is started again.
class CutOffTest : public TurningHostsTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void CutOff() const {
    if (GetParam() == "route") return hosts_->Ip(GetHost(), {"route", "del", "224.0.0.0/4"});
    hosts_->Ip(GetHost(), {"link", "set", "eth0", "down"});
  }
  void Restore() const {
    if (GetParam() == "interface") hosts_->Ip(GetHost(), {"link", "set", "eth0", "up"});
    hosts_->Ip(GetHost(), {"route", "add", "224.0.0.0/4", "dev", "eth0"});
  }
  static std::string GetHost() { return "station"; }
};

TEST_P(CutOffTest, GoesOnWhenItIsBack) {
  ASSERT_TRUE(AllTurn(30s));
  CutOff();
  const auto cut = Clock::now();
  // A second after the last command each UAV holds speed and course, level, and goes on doing so. What is
  // tried is a cut that is longer than it takes to call a link lost.
  const auto holds = [](const vehicle_state_t& before, const vehicle_state_t& now) {
    return std::abs(now.course_rad - before.course_rad) < 1e-4 && std::abs(now.climb_rad) < 1e-3 &&
           std::abs(now.speed_m_s - before.speed_m_s) < 1e-3;
  };
  EXPECT_TRUE(UavsAre(holds, 2s));
  EXPECT_FALSE(UavsAre([&](const auto& before, const auto& now) { return !holds(before, now); },
                       6s - (Clock::now() - cut)));
  {
    const Hosts::Stay stay = hosts_->On("operator");
    EXPECT_FALSE(Hears<formation_status_t>(
        kUrl, bus::channel::kFormationStatus, [](const auto&) { return true; }, 1s));
  }
  Restore();
  const auto healed = Clock::now();
  EXPECT_TRUE(LinksAre(link_status_t::LINK_UP, 15s));
  const Seconds up = Clock::now() - healed;
  EXPECT_TRUE(HoldsSlots(20, 200s));
  std::cout << "cut off for 6 s in a turn: links up after " << up.count()
            << " s, in formation within 20 m after " << Seconds(Clock::now() - healed).count() << " s\n";
}

INSTANTIATE_TEST_SUITE_P(Station, CutOffTest, ::testing::Values("route", "interface"),
                         [](const auto& named) { return named.param; });

/// The clock of the station is off from that of the others.
class ClockOffTest : public HostsTest, public ::testing::WithParamInterface<std::string> {
 protected:
  ClockOffTest() {
    environments_["station"] = {{"LD_PRELOAD", FakeTimeLibrary()},
                                {"FAKETIME", GetParam()},
                                {"FAKETIME_DONT_FAKE_MONOTONIC", "1"},
                                {"SKEIN_CLOCK_FILE", folder_ + "/station-clock"}};
  }
  ~ClockOffTest() override {
    processes_.clear();
    std::filesystem::remove_all(folder_);
  }
  const std::string folder_ = FreshFolder("skein-hosts");
};

TEST_P(ClockOffTest, IsToldAndFakesNoLostLink) {
  ASSERT_NE(FakeTimeLibrary(), "") << "libfaketime is missing: scripts/setup test";
  {
    const Hosts::Stay stay = hosts_->On("operator");
    const std::string text = std::string("the clock of fleet-simulator is 2.0 s ") +
                             (GetParam() == "+2" ? "behind" : "ahead of") +
                             " the monitor's: synchronise the hosts";
    std::string told;
    EXPECT_TRUE(Hears<alarm_list_t>(
        kUrl, bus::channel::kAlarms,
        [&](const alarm_list_t& list) {
          for (const alarm_t& alarm : list.alarms) {
            if (alarm.condition == "clock:fleet-simulator") told = alarm.text;
          }
          return told == text;
        },
        10s))
        << told;
  }
  Heard heard = Listen(8s);
  EXPECT_GT(heard.link_states["up"], 0);
  EXPECT_EQ(heard.link_states["late"] + heard.link_states["lost"] + heard.link_states["unknown"], 0);
  EXPECT_LE(heard.worst_slot_m, 20);
  EXPECT_EQ(heard.worst_climb_m, 0) << "somebody is avoided";
}

INSTANTIATE_TEST_SUITE_P(Station, ClockOffTest, ::testing::Values("+2", "-2"),
                         [](const auto& named) { return named.param == "+2" ? "Ahead" : "Behind"; });

TEST_F(HostsTest, KeepThePageAndItsCommandsOverABadNetwork) {
  Start("operator", "web-bridge", {"--port", "8080"});
  hosts_->SetWire(R"({"loss": 0.1, "delay_s": 0.2, "jitter_s": 0.05, "duplicate": 0.02})");
  const Hosts::Stay stay = hosts_->On("operator");
  ASSERT_TRUE(processes_["web-bridge"]->WaitForOutput("http://127.0.0.1:8080", 10s));
  for (const char* what : {"hold", "resume"}) {
    const Finished done = RunToEnd({Program("skein"), "--lcm-url", kUrl, "formation", what, "1"});
    EXPECT_EQ(done.exit_code, 0) << done.output;
  }
  const Finished page =
      RunToEnd({"python3", "-c",
                "import urllib.request; "
                "print(urllib.request.urlopen('http://127.0.0.1:8080/api/vehicles').read().decode())"});
  EXPECT_EQ(page.exit_code, 0) << page.output;
  EXPECT_NE(page.output.find("UAV3"), std::string::npos) << page.output;
}

}  // namespace
}  // namespace skein::testing

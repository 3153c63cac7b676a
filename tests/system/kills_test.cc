// Processes of scripts/run killed outright at random moments: they come back, and the flight goes on as if
// nothing had been.

#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <thread>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/live_executor.h"
#include "bus/transport.h"
#include "core/frames.h"
#include "system/bus_ear.h"
#include "system/process.h"
#include "unit/bridge/live_client.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const std::vector<std::string> kVictims{"fleet-simulator", "formation-controller", "collision-monitor",
                                        "web-bridge",      "flight-recorder",      "lcm-logger"};
/// What a process is promised to be back within, and so how old what it commands may have become.
constexpr double kBack_s = 2;

/// A node that was there before the flight and is silent since: an alarm that stays.
const std::string kSilentNode = "payload-computer";

/// Listens all the time, and notes what must not happen.
class Watcher {
  template <typename Read>
  auto Locked(Read read) const {
    const std::lock_guard lock(mutex_);
    return read();
  }

 public:
  explicit Watcher(const std::string& url) : transport_(bus::MakeTransport(url)), executor_(transport_.lcm) {
    bus_.Subscribe<fleet_roster_t>(bus::channel::kFleetRoster, [this](const fleet_roster_t& roster) {
      const std::lock_guard lock(mutex_);
      for (const vehicle_info_t& info : roster.vehicles) models_[info.id] = info;
      flights_.insert(roster.start_utime);
    });
    bus_.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [this](const fleet_command_t& commands) {
      for (const vehicle_command_t& command : commands.commands) Judge(commands, command);
    });
    bus_.Subscribe<formation_status_t>(bus::channel::kFormationStatus,
                                       [this](const formation_status_t& status) {
                                         const std::lock_guard lock(mutex_);
                                         status_ = status;
                                       });
    bus_.Subscribe<formation_t>(bus::channel::kFormation, [this](const formation_t& formation) {
      const std::lock_guard lock(mutex_);
      formation_ = formation;
      formation_.utime = 0;
    });
    bus_.Subscribe<path_t>(bus::channel::kPath, [this](const path_t& path) {
      const std::lock_guard lock(mutex_);
      path_ = path;
    });
    bus_.Subscribe<heartbeat_t>(bus::channel::kHeartbeat, [this](const heartbeat_t& heartbeat) {
      const std::lock_guard lock(mutex_);
      sessions_[heartbeat.heartbeat_node] = heartbeat.session_id;
    });
    bus_.Subscribe<alarm_list_t>(bus::channel::kAlarms, [this](const alarm_list_t& list) {
      const std::lock_guard lock(mutex_);
      for (const alarm_t& alarm : list.alarms) {
        if (alarm.condition == "node_silent:" + kSilentNode) alarms_[alarm.id] = alarm;
      }
    });
    executor_.Every(bus::kSecond, [this] {
      heartbeat_t heartbeat{};
      heartbeat.utime = executor_.Now();
      heartbeat.heartbeat_node = kSilentNode;
      if (beats_-- > 0) bus_.Publish(bus::channel::kHeartbeat, heartbeat);
    });
    thread_ = std::thread([this] { executor_.Run(); });
  }
  ~Watcher() {
    executor_.Stop();
    thread_.join();
  }
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  std::vector<std::string> wrong() const {
    return Locked([this] { return wrong_; });
  }
  std::size_t flights() const {
    return Locked([this] { return flights_.size(); });
  }
  formation_t formation() const {
    return Locked([this] { return formation_; });
  }
  path_t path() const {
    return Locked([this] { return path_; });
  }
  std::int64_t session(const std::string& node) const {
    return Locked([&] {
      const auto found = sessions_.find(node);
      return found == sessions_.end() ? 0 : found->second;
    });
  }
  /// All alarms that the silent node ever was the reason for.
  std::vector<alarm_t> alarms() const {
    return Locked([this] {
      std::vector<alarm_t> all;
      for (const auto& [id, alarm] : alarms_) all.push_back(alarm);
      return all;
    });
  }
  /// The farthest that a UAV is from its slot [m]; NaN when nothing was heard.
  double farthest_m() const {
    return Locked([this] {
      double farthest = status_.slots.empty() ? std::nan("") : 0;
      for (const slot_status_t& slot : status_.slots)
        farthest = std::max(farthest, std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m));
      return farthest;
    });
  }

 private:
  /// Whether a UAV is in its slot, as far as was told last. One on its way there, after its link was lost
  /// (the scenario sees to that), is commanded as hard as it can fly, whether anything is killed or not.
  bool InPlace(int id) const {
    constexpr double kNear_m = 50;
    return std::any_of(status_.slots.begin(), status_.slots.end(), [&](const slot_status_t& slot) {
      return slot.vehicle_id == id && slot.flown &&
             std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m) < kNear_m;
    });
  }

  /// No setpoint is farther from the last one than the UAV could have got in between and in kBack_s.
  void Judge(const fleet_command_t& from, const vehicle_command_t& command) {
    const std::lock_guard lock(mutex_);
    if (!InPlace(command.id)) {
      last_.erase(command.id);
      return;
    }
    const auto model = models_.find(command.id);
    const auto [last, first] = last_.try_emplace(command.id, from.utime, command);
    if (!first && model != models_.end()) {
      const double time_s = kBack_s + std::abs(bus::ToSeconds(from.utime - last->second.first));
      const vehicle_command_t& before = last->second.second;
      const auto within = [&](const char* what, double step, double rate) {
        if (std::abs(step) <= rate * time_s) return;
        wrong_.push_back(fmt::format("{} of UAV{} steps by {:.3f} within {:.2f} s", what, command.id, step,
                                     time_s - kBack_s));
      };
      within("speed", command.setpoint_speed_m_s - before.setpoint_speed_m_s,
             model->second.max_acceleration_m_s2);
      within("course", WrapAngle(command.setpoint_course_rad - before.setpoint_course_rad),
             model->second.max_course_rate_rad_s);
      within("climb", command.setpoint_climb_rad - before.setpoint_climb_rad,
             model->second.max_climb_rate_rad_s);
    }
    last->second = {from.utime, command};
  }

  bus::Transport transport_;
  bus::LiveExecutor executor_;
  bus::Bus bus_{transport_.lcm, "system-test", executor_};
  mutable std::mutex mutex_;
  std::map<int, vehicle_info_t> models_;
  std::set<std::int64_t> flights_;
  std::map<int, std::pair<bus::Utime, vehicle_command_t>> last_;
  std::map<std::string, std::int64_t> sessions_;
  int beats_ = 4;  ///< heartbeats that the silent node still sends
  std::map<std::int64_t, alarm_t> alarms_;
  formation_status_t status_{};
  formation_t formation_{};
  path_t path_{};
  std::vector<std::string> wrong_;
  std::thread thread_;
};

/// Waits until it is so, at most `timeout`. @return whether it is, and after how long.
std::pair<bool, double> Await(const std::function<bool()>& is_so, Seconds timeout) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const double passed_s = Seconds(std::chrono::steady_clock::now() - start).count();
    if (is_so()) return {true, passed_s};
    if (passed_s > timeout.count()) return {false, passed_s};
    std::this_thread::sleep_for(10ms);
  }
}

/// A page that asks for control, and comes back with its token when the bridge was gone.
class Page {
 public:
  Page(int port, const std::string& name)
      : port_(static_cast<std::uint16_t>(port)), name_(name), token_(name + std::string(32, 't')) {
    Join();
  }

  /// Whether this page holds control, after having come back if it had to.
  bool Holds() {
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        if (!browser_) Join();
        browser_->Send(R"({"type":"control","id":"t","action":"take"})");
        const json ack = browser_->ReadText("ack");
        if (!ack.is_null()) return ack["accepted"];
      } catch (const std::exception&) {
      }
      browser_.reset();
    }
    return false;
  }

 private:
  void Join() {
    browser_ = std::make_unique<bridge::LiveClient>(port_);
    const json join = {{"type", "control"}, {"id", "j"},     {"action", "join"},
                       {"name", name_},     {"page", name_}, {"token", token_}};
    browser_->Send(join.dump());
    if (browser_->ReadText("ack").is_null()) throw std::runtime_error("the bridge is gone");
  }

  std::uint16_t port_;
  std::string name_;
  std::string token_;
  std::unique_ptr<bridge::LiveClient> browser_;
};

int FromEnvironment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

TEST(Kills, LeaveTheFlightAsItWas) {
  const int kills = FromEnvironment("SKEIN_KILLS", 10);
  const double flight_s = FromEnvironment("SKEIN_KILLS_SECONDS", 40);
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << ", " << kills << " kills in " << flight_s << " s\n";
  std::mt19937 random(seed);
  const std::string url = FreshLcmUrl();
  const int port = FreeTcpPort();
  Process run({std::string(SKEIN_SOURCE_DIR) + "/scripts/run", "triangle", "--port", std::to_string(port),
               "--lcm-url", url});
  ASSERT_TRUE(run.WaitForOutput("http://127.0.0.1:" + std::to_string(port), 60s)) << run.output();
  Watcher watcher(url);
  ASSERT_TRUE(Await([&] { return watcher.farthest_m() < 20; }, 120s).first) << watcher.farthest_m();
  const Finished marked = RunToEnd({Program("skein"), "--lcm-url", url, "formation", "hold", "1"});
  ASSERT_EQ(marked.exit_code, 0) << marked.output;
  ASSERT_TRUE(Await([&] { return watcher.formation().hold; }, 5s).first);
  ASSERT_TRUE(Await([&] { return !watcher.alarms().empty(); }, 15s).first);
  const alarm_t alarm = watcher.alarms().front();
  const Finished seen =
      RunToEnd({Program("skein"), "--lcm-url", url, "alarm", "ack", std::to_string(alarm.id)});
  ASSERT_EQ(seen.exit_code, 0) << seen.output;
  Page page(port, "Ada");
  ASSERT_TRUE(page.Holds());
  Page other(port, "Bob");
  ASSERT_FALSE(other.Holds());
  const formation_t formation = watcher.formation();
  const std::int64_t revision = watcher.path().path_revision;

  std::map<std::string, double> slowest_s;
  const auto all = [&] {
    std::map<std::string, pid_t> pids;
    for (const std::string& name : kVictims) pids[name] = FindProcess(name, url);
    return pids;
  };
  for (int i = 0; i < kills; ++i) {
    const std::string victim = kVictims[random() % kVictims.size()];
    SCOPED_TRACE("kill " + std::to_string(i + 1) + ": " + victim);
    const auto before = all();
    const std::int64_t session = watcher.session(victim);
    ASSERT_GT(before.at(victim), 0);
    kill(before.at(victim), SIGKILL);
    const auto [back, after_s] = Await(
        [&] {
          if (victim != "lcm-logger") return watcher.session(victim) > session;
          const pid_t now = FindProcess(victim, url);
          return now != 0 && now != before.at(victim);
        },
        10s);
    ASSERT_TRUE(back) << run.output();
    EXPECT_LE(after_s, kBack_s);
    slowest_s[victim] = std::max(slowest_s[victim], after_s);
    if (victim == "web-bridge") {
      EXPECT_FALSE(other.Holds()) << "who comes first has taken control";
    }
    EXPECT_TRUE(page.Holds());  // also reads what has come, or it would be cut off
    for (const auto& [name, pid] : all()) {
      if (name == victim || (victim == "flight-recorder" && name == "lcm-logger")) continue;
      EXPECT_EQ(pid, before.at(name)) << name;
    }
    const double pause_s = flight_s / kills * std::uniform_real_distribution<>(0.2, 1.8)(random) - after_s;
    if (pause_s > 0) std::this_thread::sleep_for(Seconds(pause_s));
  }
  for (const auto& [name, seconds] : slowest_s)
    std::cout << fmt::format("{:<22} back after {:.2f} s at most\n", name, seconds);

  const auto [held, after_s] = Await([&] { return watcher.farthest_m() <= 20; }, 30s);
  EXPECT_TRUE(held) << watcher.farthest_m();
  std::cout << fmt::format("slots held within 20 m {:.1f} s after the last kill\n", after_s);
  EXPECT_EQ(watcher.flights(), 1u) << "the fleet never started anew";
  EXPECT_EQ(watcher.formation().slots.size(), formation.slots.size());
  EXPECT_TRUE(watcher.formation().hold) << "it holds, as it was told before";
  EXPECT_EQ(watcher.path().path_revision, revision);
  ASSERT_EQ(watcher.alarms().size(), 1u) << "an alarm is raised once";
  EXPECT_EQ(watcher.alarms().front().state, alarm_t::ACKNOWLEDGED);
  EXPECT_EQ(watcher.alarms().front().raised_utime, alarm.raised_utime);
  EXPECT_FALSE(other.Holds());
  EXPECT_TRUE(page.Holds()) << "control is the same page's";
  for (const std::string& what : watcher.wrong()) ADD_FAILURE() << what;
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
}

}  // namespace
}  // namespace skein::testing

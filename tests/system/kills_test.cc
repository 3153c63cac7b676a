// Processes of scripts/run killed outright at random moments: they come back, and the flight goes on as if
// nothing had been: on its path, while it avoids a UAV whose link is lost, and in a hold.
//
// SKEIN_KILLS: how many (default: 12), SKEIN_KILLS_SECONDS: in how much time (default: 80).

#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "system/flight_watch.h"
#include "system/process.h"
#include "unit/bridge/live_client.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const std::string kSilentAlarm = std::string("node_silent:") + FlightWatch::kSilentNode;
const std::vector<std::string> kProcesses{"fleet-simulator", "formation-controller", "collision-monitor",
                                          "web-bridge",      "flight-recorder",      "lcm-logger"};
constexpr int kCutUav = 3;
constexpr double kBack_s = 2;

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

/// Who is killed one after the other: each process once, then any.
std::vector<std::string> Victims(int kills, std::mt19937& random) {
  std::vector<std::string> victims = kProcesses;
  std::shuffle(victims.begin(), victims.end(), random);
  while (static_cast<int>(victims.size()) < kills)
    victims.push_back(kProcesses[random() % kProcesses.size()]);
  victims.resize(static_cast<std::size_t>(kills));
  return victims;
}

/// The octagon, on every second side of which a UAV's link is cut, where it is straight; not in the hold, in
/// which it would be left behind.
std::string ScenarioWithCuts(const std::string& folder, double hold_s) {
  json scenario = json::parse(std::ifstream(SKEIN_SOURCE_DIR "/tests/system/octagon.json"));
  double at_s = 44;
  do {
    scenario["timeline"].push_back({{"at_s", at_s}, {"cut_link", kCutUav}, {"for_s", 16}});
    at_s += 158.1;
  } while (at_s + 40 < hold_s);
  const std::string file = folder + "/octagon-with-cuts.json";
  std::ofstream(file) << scenario.dump(1);
  return file;
}

class KillsTest : public ::testing::Test {
 protected:
  ~KillsTest() override { std::filesystem::remove_all(folder_); }
  void SetUp() override {
    std::cout << "seed " << seed_ << ", " << kills_ << " kills in " << flight_s_ << " s\n";
    ASSERT_TRUE(run_.WaitForOutput("http://127.0.0.1:" + std::to_string(port_), 60s)) << run_.output();
    ASSERT_TRUE(Await([&] { return watch_.FarthestFromSlot() < 20; }, 30s).first)
        << watch_.FarthestFromSlot();
    watch_.BeASilentNode();
    ASSERT_TRUE(Await([&] { return watch_.Alarm(kSilentAlarm).has_value(); }, 15s).first);
    Skein({"alarm", "ack", std::to_string(watch_.Alarm(kSilentAlarm)->id)});
    ASSERT_TRUE(Await([&] { return watch_.Alarm(kSilentAlarm)->state == alarm_t::ACKNOWLEDGED; }, 5s).first);
    alarm_ = *watch_.Alarm(kSilentAlarm);
  }

  void Skein(std::vector<std::string> words) const {
    words.insert(words.begin(), {Program("skein"), "--lcm-url", url_});
    const Finished done = RunToEnd(words);
    ASSERT_EQ(done.exit_code, 0) << done.output;
  }
  std::map<std::string, pid_t> Pids() const {
    std::map<std::string, pid_t> pids;
    for (const std::string& name : kProcesses) pids[name] = FindProcess(name, url_);
    return pids;
  }

  /// Kills it, waits until it is back, and looks whether the others and the avoidance are as they were.
  void Kill(const std::string& victim) {
    const auto before = Pids();
    const std::int64_t session = watch_.session(victim);
    const formation_status_t was = watch_.status();
    const bool was_cut = !watch_.IsHeard(kCutUav);
    ASSERT_GT(before.at(victim), 0);
    kill(before.at(victim), SIGKILL);
    const auto [back, after_s] = Await(
        [&] {
          if (victim != "lcm-logger") return watch_.session(victim) > session;
          const pid_t now = FindProcess(victim, url_);
          return now != 0 && now != before.at(victim);
        },
        10s);
    ASSERT_TRUE(back) << run_.output();
    EXPECT_LE(after_s, kBack_s);
    slowest_s_[victim] = std::max(slowest_s_[victim], after_s);
    for (const auto& [name, pid] : Pids()) {
      if (name == victim || (victim == "flight-recorder" && name == "lcm-logger")) continue;
      EXPECT_EQ(pid, before.at(name)) << name;
    }
    ASSERT_TRUE(Await([&, now = watch_.now()] { return watch_.status().utime > now; }, 3s).first);
    const formation_status_t is = watch_.status();
    if (was.mode == formation_status_t::MODE_AVOIDING && was_cut && !watch_.IsHeard(kCutUav)) {
      EXPECT_EQ(is.mode, was.mode) << is.mode_text;
      EXPECT_EQ(is.mode_utime, was.mode_utime);
      EXPECT_EQ(is.avoidance_target_m, was.avoidance_target_m);
    }
  }
  bool Avoids() const {
    const formation_status_t status = watch_.status();
    return status.mode == formation_status_t::MODE_AVOIDING && status.avoidance_up_m > 20;
  }
  bool AvoidsNothing() const {
    const formation_status_t status = watch_.status();
    return watch_.IsHeard(kCutUav) && status.avoidance_target_m == 0 && status.avoidance_up_m == 0;
  }
  void ExpectAsBefore(const formation_t& formation, const path_t& path) const {
    EXPECT_TRUE(Same(watch_.formation(), formation));
    EXPECT_TRUE(Same(watch_.path(), path));
    EXPECT_EQ(watch_.flights().size(), 1U) << "the fleet has started anew";
  }

  const int kills_ = FromEnvironment("SKEIN_KILLS", 12);
  const double flight_s_ = FromEnvironment("SKEIN_KILLS_SECONDS", 80);
  const unsigned seed_ = std::random_device{}();
  std::mt19937 random_{seed_};
  const std::string url_ = FreshLcmUrl();
  const int port_ = FreeTcpPort();
  const std::string folder_ = FreshFolder("skein-kills");
  const std::string scenario_ = ScenarioWithCuts(folder_, flight_s_ * 5 / 6);
  FlightJudge judge_{scenario_, flight_s_ + 300};
  Process run_{{std::string(SKEIN_SOURCE_DIR) + "/scripts/run", scenario_, "--port", std::to_string(port_),
                "--lcm-url", url_}};
  FlightWatch watch_{url_, judge_};
  alarm_t alarm_{};
  std::map<std::string, double> slowest_s_;
};

TEST_F(KillsTest, LeaveTheFlightAsItWas) {
  Page page(port_, "Ada");
  ASSERT_TRUE(page.Holds());
  Page other(port_, "Bob");
  ASSERT_FALSE(other.Holds());
  formation_t formation = watch_.formation();
  path_t path = watch_.path();

  bool killed_controller = false;  // in this avoidance
  int avoidances = 0;
  const auto kill_in_a_climb = [&](Seconds within) {
    if (!Await([&] { return Avoids() && !killed_controller; }, within).first) return;
    SCOPED_TRACE("controller in a climb");
    ++avoidances;
    killed_controller = true;
    Kill("formation-controller");
  };
  const std::vector<std::string> victims = Victims(kills_, random_);
  for (int i = 0; i < kills_; ++i) {
    if (i == kills_ * 5 / 6) {
      if (avoidances == 0) {  // the dice were fast, or the link was found lost too late
        Skein({"link", "cut", std::to_string(kCutUav), "--for", "20"});
        kill_in_a_climb(30s);
      }
      ASSERT_TRUE(Await([&] { return AvoidsNothing(); }, 90s).first) << watch_.status().mode_text;
      ExpectAsBefore(formation, path);
      watch_.ExpectOtherPath();
      Skein({"formation", "hold", "1"});
      ASSERT_TRUE(Await([&] { return watch_.formation().hold && !Same(watch_.path(), path); }, 5s).first);
      formation = watch_.formation();
      path = watch_.path();
    }
    const std::string victim = victims[static_cast<std::size_t>(i)];
    SCOPED_TRACE("kill " + std::to_string(i + 1) + ": " + victim);
    Kill(victim);
    if (HasFatalFailure()) return;
    if (victim == "web-bridge") {
      EXPECT_FALSE(other.Holds()) << "who comes first has taken control";
    }
    EXPECT_TRUE(page.Holds());  // also reads what has come, or it would be cut off
    if (!Avoids()) killed_controller = false;
    const double pause_s = flight_s_ / kills_ * std::uniform_real_distribution<>(0.2, 1.8)(random_);
    kill_in_a_climb(Seconds(pause_s));
    if (HasFatalFailure()) return;
  }
  const bus::Utime last_kill = watch_.now();
  for (const auto& [name, seconds] : slowest_s_)
    std::cout << fmt::format("{:<22} back after {:.2f} s at most\n", name, seconds);
  EXPECT_GT(avoidances, 0);

  const auto [held, after_s] = Await([&] { return watch_.FarthestFromSlot(last_kill) <= 20; }, 30s);
  EXPECT_TRUE(held) << watch_.FarthestFromSlot(last_kill);
  std::cout << fmt::format(
      "slots held within 20 m {:.1f} s after the last kill; nearest to a step that is too large: {}\n",
      after_s, watch_.closest());
  ExpectAsBefore(formation, path);
  ASSERT_TRUE(Await([&] { return watch_.Alarm(kSilentAlarm, last_kill).has_value(); }, 5s).first)
      << "the alarm is forgotten";
  EXPECT_TRUE(Same(*watch_.Alarm(kSilentAlarm), alarm_));
  EXPECT_FALSE(other.Holds());
  EXPECT_TRUE(page.Holds()) << "control is the same page's";
  for (const std::string& what : watch_.wrong()) ADD_FAILURE() << what;
  run_.Signal(SIGINT);
  EXPECT_EQ(run_.WaitForEnd(15s), 0) << run_.output();
}

}  // namespace
}  // namespace skein::testing

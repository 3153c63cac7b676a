#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "unit/monitor/monitor_fixture.h"

namespace skein::monitor {
namespace {

/// Ends with the process that it belongs to: what was to be done later is not done any more.
class MortalExecutor : public bus::Executor {
 public:
  explicit MortalExecutor(bus::Executor& world) : world_(world) {}
  ~MortalExecutor() override { *alive_ = false; }

  bus::Utime Now() const override { return world_.Now() + *ahead_; }
  void Every(bus::Utime period, std::function<void()> callback, bus::Utime phase) override {
    world_.Every(period, WhileAlive(std::move(callback)), phase);
  }
  void At(bus::Utime when, std::function<void()> callback) override {
    world_.At(when - *ahead_, WhileAlive(std::move(callback)));
  }
  void SetAhead(bus::Utime ahead) { *ahead_ = ahead; }

 private:
  std::function<void()> WhileAlive(std::function<void()> callback) const {
    return [alive = alive_, callback = std::move(callback)] {
      if (*alive) callback();
    };
  }

  bus::Executor& world_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  std::shared_ptr<bus::Utime> ahead_ = std::make_shared<bus::Utime>(0);
};

/// A monitor with a state file that is killed and started again while its fleet flies on.
class MonitorRestart : public testing::MonitorTest {
 protected:
  MonitorRestart() {
    fleet_.Add(1, 0, 0, 1000);
    fleet_.Add(2, 0, 2000, 1000);
    fleet_.Add(3, 0, -2000, 1000);
    fleet_.start_utime = executor_.Now();
    options_.state_file =
        std::filesystem::temp_directory_path() / ("skein_monitor_restart_" + std::to_string(::getpid()));
    std::filesystem::remove(options_.state_file);
  }
  ~MonitorRestart() override {
    Kill();
    std::filesystem::remove(options_.state_file);
  }

  struct Process {
    Process(bus::Executor& world, const std::shared_ptr<lcm::LCM>& transport,
            const CollisionMonitorOptions& options, double clock_ahead_s)
        : executor(world),
          bus((executor.SetAhead(bus::ToUtime(clock_ahead_s)), transport), "collision-monitor", executor),
          node(bus, options) {}
    MortalExecutor executor;
    bus::Bus bus;
    CollisionMonitorNode node;
  };

  void StartProcess(double clock_ahead_s = 0) {
    process_ = std::make_unique<Process>(executor_, transport_, options_, clock_ahead_s);
  }
  void Kill() { process_.reset(); }
  /// Until all is up, and then on: what is told comes after that.
  void FlyFor(double seconds) {
    StartProcess();
    Run(seconds);
    ASSERT_TRUE(heard_.events.empty());
  }
  void KillFor(double seconds) {
    Kill();
    Run(seconds);
    StartProcess();
  }
  void SetLink(int id, bool up) { fleet_.uavs[id].downlink = fleet_.uavs[id].uplink = up; }
  double Since(bus::Utime utime, const event_t& event) const { return bus::ToSeconds(event.utime - utime); }

  CollisionMonitorOptions options_;
  std::unique_ptr<Process> process_;
};

struct Cut {
  const char* name;
  std::function<void(testing::FakeUav&)> make;
};

class MonitorRestartAfterACut : public MonitorRestart, public ::testing::WithParamInterface<Cut> {};

TEST_P(MonitorRestartAfterACut, TellsTheLossAsEarlyAsIfItHadNotBeenKilled) {
  for (const double phase : {0.0, 0.11, 0.23}) {
    for (const double cut_before_kill : {0.02, 0.05, 1.0, 2.5, 3.7}) {
      for (const double away : {0.3, 1.1, 2.2}) {
        SCOPED_TRACE(::testing::Message() << "phase " << phase << " cut " << cut_before_kill
                                          << " s before a kill for " << away << " s");
        fleet_.uavs[3] = {};
        fleet_.Add(3, 0, -2000, 1000);
        heard_.events.clear();
        StartProcess();
        Run(10 + phase);
        heard_.events.clear();
        const bus::Utime cut = executor_.Now();
        GetParam().make(fleet_.uavs[3]);
        Run(cut_before_kill);
        KillFor(away);
        Run(10);
        ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
        const event_t lost = heard_.Events("link_lost")[0];
        EXPECT_EQ(lost.vehicle_id, 3);
        EXPECT_EQ(lost.text.find("never heard"), std::string::npos) << lost.text;
        EXPECT_GE(Since(cut, lost), 3.6);
        // Whoever comes back late listens before it tells.
        const double first_s = cut_before_kill + away;
        EXPECT_LE(Since(cut, lost), std::max(5.0, first_s + 3.7));
        EXPECT_TRUE(heard_.Events("fleet_silent").empty());
        Kill();
        std::filesystem::remove(options_.state_file);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Links, MonitorRestartAfterACut,
    ::testing::Values(Cut{"Both", [](testing::FakeUav& uav) { uav.downlink = uav.uplink = false; }},
                      Cut{"Downlink", [](testing::FakeUav& uav) { uav.downlink = false; }},
                      Cut{"Uplink", [](testing::FakeUav& uav) { uav.uplink = false; }},
                      Cut{"Frozen", [](testing::FakeUav& uav) { uav.frozen = true; }}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(MonitorRestart, TellsNothingOfLinksThatAreInOrderHoweverLongItWasAway) {
  FlyFor(10);
  for (const double away : {0.1, 1.0, 1.9, 2.5, 3.9, 4.5, 30.0, 59.0, 3600.0}) {
    KillFor(away);
    Run(10);
    for (const event_t& event : heard_.events) EXPECT_EQ(event.code, "monitor_restarted") << event.text;
    for (const int id : {1, 2, 3}) {
      EXPECT_EQ(heard_.Link(id)->downlink, link_status_t::LINK_UP) << id << " after " << away;
      EXPECT_EQ(heard_.Link(id)->uplink, link_status_t::LINK_UP) << id << " after " << away;
    }
  }
}

TEST_F(MonitorRestart, TellsNothingOfLinksInOrderWhoseTelemetryComesAt1Hz) {
  FlyFor(10);
  for (double phase = 0.05; phase < 1; phase += 0.05) {
    Kill();
    Run(30);
    fleet_.telemetry = false;
    Run(phase);
    StartProcess();
    for (int i = 0; i < 10; ++i) {
      Run(0.95);
      fleet_.telemetry = true;
      Run(0.05);
      fleet_.telemetry = false;
    }
    EXPECT_TRUE(heard_.Events("link_lost").empty()) << phase;
    fleet_.telemetry = true;
  }
}

TEST_F(MonitorRestart, TakesNoLinkForLostWhenTheWholeFleetWasSilentMeanwhile) {
  FlyFor(10);
  fleet_.telemetry = false;
  Run(0.5);
  KillFor(5);
  Run(6);
  EXPECT_EQ(heard_.Events("fleet_silent").size(), 1u);
  fleet_.telemetry = true;
  Run(10);
  EXPECT_EQ(heard_.Events("fleet_heard").size(), 1u);
  EXPECT_TRUE(heard_.Events("link_lost").empty());
  EXPECT_TRUE(heard_.Events("link_late").empty());
  for (const int id : {1, 2, 3}) EXPECT_EQ(heard_.Link(id)->downlink, link_status_t::LINK_UP);
}

TEST_F(MonitorRestart, TellsThatTheFleetFellSilentJustBeforeTheKill) {
  FlyFor(10);
  const bus::Utime silent = executor_.Now();
  fleet_.telemetry = fleet_.roster = false;
  Run(0.05);
  KillFor(0.4);
  Run(10);
  ASSERT_EQ(heard_.Events("fleet_silent").size(), 1u);
  EXPECT_LE(Since(silent, heard_.Events("fleet_silent")[0]), 5);
}

TEST_F(MonitorRestart, BeginsAnewWhenItsStateIsOld) {
  FlyFor(10);
  SetLink(3, false);
  Run(0.05);
  KillFor(3600);
  Run(4);
  EXPECT_TRUE(heard_.Events("link_lost").empty());
  Run(3);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_EQ(heard_.Events("link_lost")[0].text, "link of UAV3 lost: never heard");
}

TEST_F(MonitorRestart, TakesNoLinkForLostWhenItsClockHasJumpedMeanwhile) {
  FlyFor(10);
  for (const double ahead_s : {30.0, -30.0, 50'000.0, -50'000.0, 0.0}) {
    Kill();
    Run(0.4);
    StartProcess(ahead_s);
    fleet_.clock_ahead_s = ahead_s;
    Run(10);
    EXPECT_TRUE(heard_.Events("link_lost").empty()) << ahead_s;
    EXPECT_TRUE(heard_.Events("link_late").empty()) << ahead_s;
    EXPECT_TRUE(heard_.Events("fleet_silent").empty()) << ahead_s;
    for (const int id : {1, 2, 3}) EXPECT_EQ(heard_.Link(id)->downlink, link_status_t::LINK_UP) << ahead_s;
  }
}

TEST_F(MonitorRestart, FindsALossAlsoWhenItsClockWentBackMeanwhile) {
  FlyFor(10);
  SetLink(3, false);
  Run(0.05);
  Kill();
  fleet_.clock_ahead_s = -30;
  StartProcess(-30);
  Run(7);
  EXPECT_EQ(heard_.Events("link_lost").size(), 1u);
}

TEST_F(MonitorRestart, RemembersNothingOfAnotherFlight) {
  FlyFor(10);
  SetLink(3, false);
  Run(0.05);
  Kill();
  fleet_.session = 2;
  fleet_.start_utime = executor_.Now();
  Run(0.4);
  StartProcess();
  Run(7);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_EQ(heard_.Events("link_lost")[0].text, "link of UAV3 lost: never heard");
}

TEST_F(MonitorRestart, RemembersThroughASecondKillBeforeTheFleetWasHeard) {
  FlyFor(10);
  const bus::Utime cut = executor_.Now();
  SetLink(3, false);
  fleet_.roster = false;
  Run(0.05);
  KillFor(0.3);
  Run(0.8);
  KillFor(0.3);
  fleet_.roster = true;
  Run(10);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_LE(Since(cut, heard_.Events("link_lost")[0]), 5);
}

TEST_F(MonitorRestart, RemembersAlsoWhenTheFleetFliesAScenarioThatWasLoadedInFlight) {
  fleet_.scenario = "loaded";
  options_.find_options = [](const std::string&) { return CollisionMonitorOptions{}; };
  FlyFor(10.9);
  const bus::Utime cut = executor_.Now();
  fleet_.uavs[3].frozen = true;
  Run(0.05);
  KillFor(0.3);
  Run(10);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_LE(Since(cut, heard_.Events("link_lost")[0]), 5);
}

}  // namespace
}  // namespace skein::monitor

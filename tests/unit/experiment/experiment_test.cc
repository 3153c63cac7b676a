#include "experiment/experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <skein/ack_t.hpp>
#include <skein/link_command_t.hpp>

#include "bus/channels.h"

namespace skein::experiment {
namespace {

config::Scenario Shipped(const std::string& name) {
  return config::LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/" + name);
}

TEST(Experiment, ShowsEveryControlStepWhole) {
  const config::Scenario scenario = Shipped("triangle.json");
  std::int64_t steps = 0;
  ExperimentOptions options;
  options.duration_s = 10;
  options.on_tick = [&](const Tick& tick) {
    EXPECT_EQ(tick.number, steps);
    EXPECT_DOUBLE_EQ(tick.t_s, 0.05 * static_cast<double>(steps));
    ASSERT_EQ(tick.vehicles.size(), 3u);
    for (const VehicleTick& vehicle : tick.vehicles) {
      EXPECT_EQ(vehicle.heard_utime, tick.utime);
      EXPECT_TRUE(vehicle.command);
      EXPECT_EQ(vehicle.formation_id, 1);
      EXPECT_TRUE(vehicle.slot);
    }
    ASSERT_EQ(tick.formations.size(), 1u);
    EXPECT_EQ(tick.formations.at(1).tick, tick.number);
    ++steps;
  };
  EXPECT_DOUBLE_EQ(RunExperiment(scenario, options).duration_s, 10);
  EXPECT_EQ(steps, 201);
  EXPECT_EQ(steps, StepsIn(10));
}

TEST(Experiment, StartsWhereTheScenarioSays) {
  const config::Scenario scenario = Shipped("paper-assembly.json");
  Experiment experiment(scenario, {});
  const Tick& tick = experiment.Step();
  EXPECT_EQ(tick.t_s, 0);
  EXPECT_EQ(tick.vehicles[0].truth.east_m, 1000);
  EXPECT_EQ(tick.vehicles[0].truth.north_m, 3000);
  EXPECT_EQ(tick.vehicles[0].truth.up_m, 800);
  // The slot lies 1000 m behind a leader at (0, 5000, 1000) that flies north.
  EXPECT_NEAR(tick.vehicles[0].slot->forward_error_m, 1000, 1e-6);
  EXPECT_NEAR(tick.vehicles[0].slot->left_error_m, 1000, 1e-6);
  EXPECT_NEAR(tick.vehicles[0].slot->up_error_m, 200, 1e-6);
}

TEST(Experiment, LetsAnOperatorSendCommands) {
  std::vector<ack_t> acks;
  std::vector<bool> cut;
  ExperimentOptions options;
  options.duration_s = 6;
  options.on_start = [&](bus::Bus& bus) {
    bus.Subscribe<ack_t>(bus::channel::kAck, [&](const ack_t& ack) { acks.push_back(ack); });
    bus.executor().At(bus.executor().Now() + 2 * bus::kSecond, [&bus] {
      link_command_t command{};
      command.utime = bus.executor().Now();
      command.session_id = bus.session_id();
      command.request_id = 1;
      command.to_session_id = bus.session_id();
      command.vehicle_id = 2;
      command.downlink = 1;
      command.mode = link_command_t::MODE_SILENT;
      bus.Publish(bus::channel::kCmdLink, command);
    });
  };
  options.on_tick = [&](const Tick& tick) { cut.push_back(tick.vehicles[1].downlink_cut); };
  RunExperiment(Shipped("triangle.json"), options);
  ASSERT_EQ(acks.size(), 1u);
  EXPECT_TRUE(acks[0].accepted) << acks[0].reason;
  EXPECT_FALSE(cut[39]);
  EXPECT_TRUE(cut[41]);
}

TEST(Experiment, EndsEarlyWhenAsked) {
  ExperimentOptions options;
  double t_s = 0;
  options.on_tick = [&](const Tick& tick) { t_s = tick.t_s; };
  options.stop = [&] { return t_s >= 1; };
  EXPECT_DOUBLE_EQ(RunExperiment(Shipped("triangle.json"), options).duration_s, 1);
}

TEST(Experiment, FliesNobody) {
  config::Scenario nobody;
  nobody.name = "Empty";
  ExperimentOptions options;
  options.duration_s = 3;
  const Summary summary = RunExperiment(nobody, options);
  EXPECT_TRUE(summary.vehicles.empty());
  EXPECT_DOUBLE_EQ(summary.duration_s, 3);
}

TEST(Experiment, FollowsTheSeedWhereLinksLoseMessages) {
  config::Scenario scenario = Shipped("paper-assembly.json");
  scenario.vehicles[0].downlink = {.delay_s = 0.1, .jitter_s = 0.3, .loss = 0.3};
  const auto east_after_30_s = [&](std::uint64_t seed) {
    double east_m = 0;
    ExperimentOptions options;
    options.duration_s = 30;
    options.seed = seed;
    options.on_tick = [&](const Tick& tick) { east_m = tick.vehicles[0].truth.east_m; };
    RunExperiment(scenario, options);
    return east_m;
  };
  EXPECT_EQ(east_after_30_s(1), east_after_30_s(1));
  EXPECT_NE(east_after_30_s(1), east_after_30_s(2));
}

TEST(UnderControl, DropsGainsThatBelongToAnotherLaw) {
  config::Scenario scenario = Shipped("paper-assembly.json");
  scenario.formations[0].gains = {{"k_ex", 2}};
  EXPECT_EQ(UnderControl(scenario, "paper").formations[0].gains.size(), 1u);
  const config::Scenario skein = UnderControl(scenario, "skein");
  EXPECT_EQ(skein.formations[0].control, "skein");
  EXPECT_TRUE(skein.formations[0].gains.empty());
}

}  // namespace
}  // namespace skein::experiment

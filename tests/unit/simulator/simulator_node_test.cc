#include "simulator/simulator_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <skein/ack_t.hpp>
#include <skein/event_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::simulator {
namespace {

using bus::kSecond;
using bus::SimulatedExecutor;
using bus::Utime;
namespace channel = bus::channel;

config::Scenario ScenarioOf(int vehicles) {
  config::Scenario scenario;
  scenario.name = "test";
  scenario.origin = {40.08, 116.58, 30};
  for (int id = 1; id <= vehicles; ++id) {
    config::VehicleConfig vehicle;
    vehicle.id = id;
    vehicle.callsign = "UAV" + std::to_string(id);
    vehicle.start = {
        .east_m = 1000.0 * id, .up_m = 1000, .speed_m_s = 50, .course_rad = std::numbers::pi / 2};
    scenario.vehicles.push_back(vehicle);
  }
  return scenario;
}

class SimulatorTest : public testing::Test {
 protected:
  SimulatorTest() {
    bus::SubscribeChunks<fleet_state_t>(station_, channel::kFleetState,
                                        [this](const fleet_state_t& state, int missing) {
                                          EXPECT_EQ(missing, 0);
                                          states_.push_back(state);
                                        });
    bus::SubscribeChunks<fleet_roster_t>(
        station_, channel::kFleetRoster,
        [this](const fleet_roster_t& roster, int) { rosters_.push_back(roster); });
    station_.Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { events_.push_back(event); });
    station_.Subscribe<ack_t>(channel::kAck, [this](const ack_t& ack) { acks_.push_back(ack); });
  }

  void Start(const config::Scenario& scenario) {
    node_ = std::make_unique<FleetSimulatorNode>(simulator_, SimulatorOptions{scenario, 1});
  }
  /// Runs until a time of the scenario, that moment included.
  void RunUntil(double t_s) { executor_.RunUntil(SimulatedExecutor::kStart + bus::ToUtime(t_s)); }

  /// @param to_session_id 0: this flight's.
  void SendCommand(int vehicle_id, std::int64_t sequence, double speed_m_s, std::int64_t session_id = 1,
                   std::int64_t to_session_id = 0) {
    fleet_command_t command;
    command.utime = executor_.Now();
    command.session_id = session_id;
    command.request_id = sequence;
    command.to_session_id = to_session_id > 0 ? to_session_id : node_->start_utime();
    command.chunk = 0;
    command.chunk_count = 1;
    vehicle_command_t one{};
    one.id = vehicle_id;
    one.sequence = sequence;
    one.speed_input_m_s = speed_m_s;
    one.course_input_rad = std::numbers::pi / 2;
    command.commands.push_back(one);
    command.num_commands = 1;
    station_.Publish(channel::kCmdFleet, command);
    executor_.Deliver();
  }

  link_command_t Cut(int vehicle_id) {
    link_command_t command{};
    command.utime = executor_.Now();
    command.session_id = 1;
    command.request_id = ++link_requests_;
    command.to_session_id = simulator_.session_id();
    command.vehicle_id = vehicle_id;
    command.uplink = command.downlink = true;
    command.mode = link_command_t::MODE_SILENT;
    return command;
  }
  /// The answer to an operator's command.
  template <typename Command>
  ack_t Request(const char* channel_name, const Command& command) {
    acks_.clear();
    station_.Publish(channel_name, command);
    executor_.Deliver();
    EXPECT_EQ(acks_.size(), 1u);
    return acks_.empty() ? ack_t{} : acks_.front();
  }
  payload_command_t Payload(bool on, std::vector<int> ids) {
    payload_command_t command{};
    command.utime = executor_.Now();
    command.session_id = 1;
    command.request_id = ++payload_requests_;
    command.to_session_id = simulator_.session_id();
    command.on = on;
    command.vehicle_ids.assign(ids.begin(), ids.end());
    command.num_vehicle_ids = static_cast<int>(ids.size());
    return command;
  }
  /// When UAV `id` was missing from FLEET_STATE: first and last time, or nothing.
  std::vector<double> MissingTimes(int id) const {
    std::vector<double> times;
    for (const fleet_state_t& state : states_) {
      const bool heard = std::any_of(state.vehicles.begin(), state.vehicles.end(),
                                     [id](const vehicle_state_t& vehicle) { return vehicle.id == id; });
      if (!heard) times.push_back(bus::ToSeconds(state.utime - SimulatedExecutor::kStart));
    }
    return times;
  }

  std::shared_ptr<lcm::LCM> transport_ = bus::MakeTransport("memq://").lcm;
  SimulatedExecutor executor_{transport_};
  bus::Bus simulator_{transport_, "fleet-simulator", executor_};
  bus::Bus station_{transport_, "station", executor_};
  std::unique_ptr<FleetSimulatorNode> node_;
  std::vector<fleet_state_t> states_;
  std::vector<fleet_roster_t> rosters_;
  std::vector<event_t> events_;
  std::vector<ack_t> acks_;
  std::int64_t link_requests_ = 0;
  std::int64_t payload_requests_ = 0;
};

TEST_F(SimulatorTest, SendsAStateEveryTickFromTickZeroOn) {
  Start(ScenarioOf(3));
  RunUntil(10);
  ASSERT_EQ(states_.size(), 201u);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    EXPECT_EQ(states_[i].tick, static_cast<std::int64_t>(i));
    EXPECT_EQ(states_[i].utime, SimulatedExecutor::kStart + static_cast<Utime>(i) * 50'000);
    ASSERT_EQ(states_[i].vehicles.size(), 3u);
  }
  EXPECT_EQ(states_[0].vehicles[1].north_m, 0);
  EXPECT_NEAR(states_[200].vehicles[1].north_m, 500, 1e-6);
  EXPECT_EQ(node_->tick(), 200);
  EXPECT_NEAR(node_->fleet()[1].state().north_m, 500, 1e-6);
}

TEST_F(SimulatorTest, SendsTheRosterFirstAndThenEverySecond) {
  Start(ScenarioOf(2));
  RunUntil(10);
  ASSERT_EQ(rosters_.size(), 11u);
  const fleet_roster_t& roster = rosters_[0];
  EXPECT_EQ(roster.scenario, "test");
  EXPECT_EQ(roster.start_utime, SimulatedExecutor::kStart);
  EXPECT_EQ(roster.origin_latitude_deg, 40.08);
  EXPECT_EQ(roster.origin_longitude_deg, 116.58);
  EXPECT_EQ(roster.origin_altitude_m, 30);
  ASSERT_EQ(roster.vehicles.size(), 2u);
  EXPECT_EQ(roster.vehicles[1].id, 2);
  EXPECT_EQ(roster.vehicles[1].callsign, "UAV2");
  EXPECT_EQ(roster.vehicles[1].k_course_per_s, 0.1);
  EXPECT_EQ(roster.vehicles[1].max_speed_m_s, 90);
  EXPECT_EQ(rosters_[10].utime, SimulatedExecutor::kStart + 10 * kSecond);
}

TEST_F(SimulatorTest, AFleetOfNobodyStillSendsStates) {
  Start(ScenarioOf(0));
  RunUntil(1);
  ASSERT_EQ(states_.size(), 21u);
  EXPECT_TRUE(states_[20].vehicles.empty());
}

TEST_F(SimulatorTest, SendsALargeFleetInChunks) {
  Start(ScenarioOf(1000));
  int chunks = 0;
  std::size_t largest = 0;
  station_.Subscribe<fleet_state_t>(channel::kFleetState, [&](const fleet_state_t& chunk) {
    ++chunks;
    largest = std::max(largest, chunk.vehicles.size());
  });
  RunUntil(0.05);
  ASSERT_EQ(states_.size(), 2u);
  EXPECT_EQ(states_[1].vehicles.size(), 1000u);
  EXPECT_GT(chunks, 2 * 5);
  EXPECT_LT(largest, 200u);
}

TEST_F(SimulatorTest, SpreadsTheRosterOfALargeFleetOverSomeTicks) {
  Start(ScenarioOf(1000));
  int chunks = 0;
  station_.Subscribe<fleet_roster_t>(channel::kFleetRoster, [&](const fleet_roster_t&) { ++chunks; });
  for (int tick = 0; tick < 40; ++tick) {
    chunks = 0;
    RunUntil(tick * 0.05);
    EXPECT_LE(chunks, 2) << tick;
  }
  ASSERT_EQ(rosters_.size(), 2u);
  EXPECT_EQ(rosters_[1].vehicles.size(), 1000u);
  EXPECT_EQ(rosters_[1].utime, SimulatedExecutor::kStart + kSecond);
}

TEST_F(SimulatorTest, FliesWhatItIsCommandedFromTheNextStepOn) {
  Start(ScenarioOf(2));
  RunUntil(1);
  SendCommand(2, 1, 60);
  RunUntil(1.05);
  const fleet_state_t& state = states_.back();
  EXPECT_EQ(state.vehicles[0].speed_m_s, 50);
  EXPECT_NEAR(state.vehicles[1].speed_m_s, 50 + 10 * (1 - std::exp(-0.01 * 0.05)), 1e-9);
  EXPECT_EQ(state.vehicles[1].command_session_id, 1);
  EXPECT_EQ(state.vehicles[1].command_sequence, 1);
  EXPECT_EQ(state.vehicles[0].command_sequence, 0);
}

TEST_F(SimulatorTest, IgnoresCommandsForUavsThatItDoesNotHave) {
  Start(ScenarioOf(1));
  SendCommand(7, 1, 60);
  RunUntil(1);
  EXPECT_EQ(node_->fleet()[0].input().speed_m_s, 50);
}

TEST_F(SimulatorTest, ObeysNoControllerOfAnotherFlightHoweverLateItsSession) {
  Start(ScenarioOf(1));
  SendCommand(1, 5, 60, 100);
  RunUntil(0.3);
  // Out of recordings: of an earlier flight, of a later one, and of this one.
  SendCommand(1, 900, 80, 50, node_->start_utime() - 1);
  SendCommand(1, 900, 80, 200, node_->start_utime() + 1);
  SendCommand(1, 4, 80, 100);
  SendCommand(1, 900, 80, 50);
  RunUntil(0.6);
  EXPECT_EQ(node_->fleet()[0].input().speed_m_s, 60);
  EXPECT_EQ(states_.back().vehicles[0].command_session_id, 100);
  // Its own controller still has the UAV.
  SendCommand(1, 6, 65, 100);
  RunUntil(0.7);
  EXPECT_EQ(node_->fleet()[0].input().speed_m_s, 65);
  EXPECT_EQ(simulator_.statistics().gaps, 0);
}

TEST_F(SimulatorTest, CountsCommandsThatNeverCame) {
  Start(ScenarioOf(1));
  RunUntil(0);
  SendCommand(1, 1, 60);
  SendCommand(1, 2, 60);
  EXPECT_EQ(simulator_.statistics().gaps, 0);
  SendCommand(1, 5, 60);
  EXPECT_EQ(simulator_.statistics().gaps, 2);
  SendCommand(1, 4, 60);  // late, not lost after all; told apart by nobody
  SendCommand(1, 6, 60);
  EXPECT_EQ(simulator_.statistics().gaps, 2);
}

TEST_F(SimulatorTest, TimelineCutsAndRestoresALinkOnTime) {
  config::Scenario scenario = ScenarioOf(3);
  scenario.timeline = {{2.0, config::CutLink{.vehicle_id = 3, .for_s = {}}},
                       {3.0, config::RestoreLink{.vehicle_id = 3}}};
  Start(scenario);
  RunUntil(10);
  const auto missing = MissingTimes(3);
  ASSERT_EQ(missing.size(), 20u);
  EXPECT_DOUBLE_EQ(missing.front(), 2);
  EXPECT_DOUBLE_EQ(missing.back(), 2.95);
  EXPECT_TRUE(MissingTimes(1).empty());
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[0].code, "link_cut");
  EXPECT_EQ(events_[0].severity, event_t::INFO);
  EXPECT_EQ(events_[0].vehicle_id, 3);
  EXPECT_EQ(events_[0].text, "data link of UAV3 is cut");
  EXPECT_EQ(events_[1].code, "link_cut_ended");
  EXPECT_EQ(events_[1].text, "data link of UAV3 is up");
}

TEST_F(SimulatorTest, TimelineRepeats) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::CutLink{.vehicle_id = 1, .for_s = 0.5}}};
  scenario.timeline_repeat_s = 4;
  Start(scenario);
  RunUntil(10);
  std::vector<double> expected;
  for (const double begin : {1.0, 5.0, 9.0}) {
    for (int i = 0; i < 10; ++i) expected.push_back(begin + i * 0.05);
  }
  const auto missing = MissingTimes(1);
  ASSERT_EQ(missing.size(), expected.size());
  for (std::size_t i = 0; i < missing.size(); ++i) EXPECT_NEAR(missing[i], expected[i], 1e-9);
}

TEST_F(SimulatorTest, TimelineSetsQualitiesAndLeavesTheOtherDirectionAlone) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::SetLink{.vehicle_id = 1,
                                             .uplink = {},
                                             .downlink = config::LinkQuality{.delay_s = 0.2, .loss = 0.1}}}};
  Start(scenario);
  RunUntil(2);
  EXPECT_EQ(node_->fleet()[0].downlink().quality.delay_s, 0.2);
  EXPECT_EQ(node_->fleet()[0].uplink().quality.delay_s, 0);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].code, "link_set");
  EXPECT_EQ(events_[0].text,
            "data link of UAV1: uplink up, downlink up with 0.2 s delay, 0 s jitter, 10% loss");
}

TEST_F(SimulatorTest, FreezesALinkThatRepeatsItsLastState) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::CutLink{.vehicle_id = 1, .frozen = true, .for_s = {}}}};
  Start(scenario);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
  EXPECT_EQ(states_.back().vehicles[0].utime, SimulatedExecutor::kStart + bus::ToUtime(0.95));
}

TEST_F(SimulatorTest, CutsALinkForAWhileOnRequest) {
  Start(ScenarioOf(3));
  RunUntil(1);
  link_command_t command = Cut(2);
  command.duration_s = 3;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(10);
  const auto missing = MissingTimes(2);
  ASSERT_EQ(missing.size(), 59u);  // the state of t = 1 had been sent already
  EXPECT_DOUBLE_EQ(missing.front(), 1.05);
  EXPECT_DOUBLE_EQ(missing.back(), 3.95);
}

TEST_F(SimulatorTest, CutsALinkAtAGivenTime) {
  Start(ScenarioOf(3));
  RunUntil(1);
  link_command_t command = Cut(2);
  command.start_utime = SimulatedExecutor::kStart + 5 * kSecond;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(10);
  EXPECT_DOUBLE_EQ(MissingTimes(2).front(), 5);
}

TEST_F(SimulatorTest, ACutThatIsUndoneByHandDoesNotEndAgainLater) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t cut = Cut(1);
  cut.duration_s = 3;
  Request(channel::kCmdLink, cut);
  RunUntil(2);
  link_command_t restore = Cut(1);
  restore.mode = link_command_t::MODE_UP;
  Request(channel::kCmdLink, restore);
  RunUntil(3);
  Request(channel::kCmdLink, Cut(1));  // for good
  RunUntil(10);
  EXPECT_EQ(node_->fleet()[0].downlink().mode, LinkMode::kSilent);
  EXPECT_EQ(events_.size(), 3u);
}

TEST_F(SimulatorTest, RestoringBringsBackTheQualityThatTheScenarioBeganWith) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.vehicles[0].uplink.delay_s = 0.3;
  scenario.vehicles[0].downlink.loss = 0.2;
  scenario.timeline = {{5.0, config::RestoreLink{.vehicle_id = 1}}};
  Start(scenario);
  RunUntil(1);
  const auto expect_as_at_start = [this] {
    EXPECT_EQ(node_->fleet()[0].uplink().mode, LinkMode::kUp);
    EXPECT_EQ(node_->fleet()[0].uplink().quality.delay_s, 0.3);
    EXPECT_EQ(node_->fleet()[0].downlink().quality.loss, 0.2);
  };
  link_command_t command = Cut(1);
  command.mode = link_command_t::MODE_UP;  // with no delay and no loss
  Request(channel::kCmdLink, command);
  Request(channel::kCmdLink, Cut(1));
  RunUntil(2);
  EXPECT_EQ(node_->fleet()[0].downlink().quality.loss, 0);
  command = Cut(1);
  command.mode = link_command_t::MODE_RESTORED;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(3);
  expect_as_at_start();
  command = Cut(1);
  command.mode = link_command_t::MODE_UP;
  Request(channel::kCmdLink, command);
  RunUntil(6);
  expect_as_at_start();
}

TEST_F(SimulatorTest, CutsOneDirectionAlone) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t command = Cut(1);
  command.downlink = false;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  SendCommand(1, 1, 60);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
  EXPECT_EQ(states_.back().vehicles[0].command_sequence, 0);
}

TEST_F(SimulatorTest, RestoringALinkThatIsUpIsNoEvent) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t command = Cut(1);
  command.mode = link_command_t::MODE_UP;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  EXPECT_TRUE(events_.empty());
}

TEST_F(SimulatorTest, RefusesLinkCommandsThatMakeNoSense) {
  Start(ScenarioOf(1));
  RunUntil(1);
  EXPECT_EQ(Request(channel::kCmdLink, Cut(9)).reason, "there is no UAV 9");
  link_command_t none = Cut(1);
  none.uplink = none.downlink = false;
  EXPECT_EQ(Request(channel::kCmdLink, none).reason, "neither uplink nor downlink is meant");
  link_command_t loss = Cut(1);
  loss.loss = 1.5;
  EXPECT_FALSE(Request(channel::kCmdLink, loss).accepted);
  link_command_t delay = Cut(1);
  delay.delay_s = 1e6;
  EXPECT_FALSE(Request(channel::kCmdLink, delay).accepted);
  link_command_t duration = Cut(1);
  duration.duration_s = -1;
  EXPECT_FALSE(Request(channel::kCmdLink, duration).accepted);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
}

TEST_F(SimulatorTest, SwitchesPayloadsOverTheUplink) {
  Start(ScenarioOf(3));
  RunUntil(1);
  const ack_t ack = Request(channel::kCmdPayload, Payload(true, {1, 3}));
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.reason, "");
  RunUntil(2);
  EXPECT_TRUE(states_.back().vehicles[0].payload_on);
  EXPECT_FALSE(states_.back().vehicles[1].payload_on);
  EXPECT_TRUE(states_.back().vehicles[2].payload_on);
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[0].code, "payload_on");
  EXPECT_EQ(events_[0].text, "payload of UAV1 is on");
  Request(channel::kCmdPayload, Payload(false, {1}));
  RunUntil(3);
  EXPECT_FALSE(states_.back().vehicles[0].payload_on);
  EXPECT_EQ(events_.back().code, "payload_off");
}

TEST_F(SimulatorTest, SaysWhenAPayloadCannotBeReached) {
  Start(ScenarioOf(2));
  RunUntil(1);
  Request(channel::kCmdLink, Cut(2));
  const ack_t ack = Request(channel::kCmdPayload, Payload(true, {1, 2}));
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.reason, "the uplink is cut: UAV2");
  RunUntil(2);
  EXPECT_TRUE(node_->fleet()[0].payload_on());
  EXPECT_FALSE(node_->fleet()[1].payload_on());
}

TEST_F(SimulatorTest, RefusesPayloadCommandsAsAWhole) {
  config::Scenario scenario = ScenarioOf(2);
  scenario.vehicles[1].has_payload = false;
  Start(scenario);
  RunUntil(1);
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {})).reason, "no UAV is named");
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {1, 9})).reason, "there is no UAV 9");
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {1, 2})).reason, "UAV2 has no payload");
  RunUntil(2);
  EXPECT_FALSE(node_->fleet()[0].payload_on());
}

TEST_F(SimulatorTest, FliesTheSameTwice) {
  const auto fly = [](std::uint64_t seed) {
    const auto transport = bus::MakeTransport("memq://").lcm;
    SimulatedExecutor executor(transport);
    bus::Bus simulator(transport, "fleet-simulator", executor);
    bus::Bus station(transport, "station", executor);
    config::Scenario scenario = ScenarioOf(5);
    for (config::VehicleConfig& vehicle : scenario.vehicles) {
      vehicle.downlink = {.delay_s = 0.1, .jitter_s = 0.2, .loss = 0.2};
    }
    std::vector<std::pair<int, Utime>> heard;
    station.Subscribe<fleet_state_t>(channel::kFleetState, [&](const fleet_state_t& state) {
      for (const vehicle_state_t& vehicle : state.vehicles) heard.emplace_back(vehicle.id, vehicle.utime);
    });
    FleetSimulatorNode node(simulator, {scenario, seed});
    executor.RunFor(10 * kSecond);
    return heard;
  };
  EXPECT_EQ(fly(1), fly(1));
  EXPECT_NE(fly(1), fly(2));
}

/// An executor whose process was held up: time leaps between two ticks.
TEST_F(SimulatorTest, MakesUpForTheFlightWhenItWasHeldUp) {
  class Leaping : public bus::Executor {
   public:
    Utime Now() const override { return now; }
    void Every(Utime, std::function<void()> callback, Utime) override { tick = std::move(callback); }
    void At(Utime, std::function<void()>) override {}
    Utime now = SimulatedExecutor::kStart;
    std::function<void()> tick;
  } leaping;
  bus::Bus simulator(transport_, "fleet-simulator", leaping);
  FleetSimulatorNode node(simulator, {ScenarioOf(1), 1});
  leaping.tick();
  leaping.now += bus::ToUtime(10.012);
  leaping.tick();
  leaping.tick();
  executor_.Deliver();
  ASSERT_EQ(states_.size(), 2u);
  EXPECT_EQ(states_[1].tick, 200);
  EXPECT_EQ(states_[1].utime, SimulatedExecutor::kStart + 10 * kSecond);
  EXPECT_NEAR(states_[1].vehicles[0].north_m, 500, 1e-6);
  EXPECT_EQ(rosters_.size(), 2u);
}

}  // namespace
}  // namespace skein::simulator

#include <gtest/gtest.h>

#include <vector>

#include "bus/refusals.h"
#include "unit/simulator/simulator_under_test.h"

namespace skein::simulator {
namespace {

using bus::kSecond;
using bus::Utime;

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

TEST_F(SimulatorTest, CountsCommandsThatCannotBeMeantAndTellsEachReasonOnce) {
  bus::TellRefusals(simulator_);
  Start(ScenarioOf(2));
  RunUntil(10);
  const auto refused = [this] { return simulator_.statistics().undecodable; };
  SendCommand(1, 500, 60, 100);
  EXPECT_EQ(refused(), 0);
  for (int i = 0; i < 3; ++i) SendCommand(7, 501 + i, 60, 100);
  EXPECT_EQ(refused(), 3) << "a UAV that is not there";
  for (int i = 0; i < 3; ++i) SendCommand(1, 900, 80, 100, node_->start_utime() - 1);
  EXPECT_EQ(refused(), 6) << "another flight";
  for (int i = 0; i < 3; ++i) SendCommand(1, 900, 80, 50);
  EXPECT_EQ(refused(), 9) << "an earlier controller";
  for (int i = 0; i < 3; ++i) SendCommand(1, 400, 80, 100);
  EXPECT_EQ(refused(), 12) << "tick 0 again";
  RunUntil(12);
  EXPECT_EQ(states_.back().vehicles[0].command_sequence, 500);
  std::vector<std::string> told;
  for (const event_t& event : events_) {
    if (event.code == "message_refused") told.push_back(event.text);
  }
  EXPECT_EQ(told.size(), 4U) << ::testing::PrintToString(told);
}

TEST_F(SimulatorTest, RefusesAnAnswerToAStateThatIsYetToCome) {
  Start(ScenarioOf(1));
  RunUntil(10);
  SendCommand(1, 500, 60, 100);
  state_tick_ = 20 * 86'400;
  SendCommand(1, 501, 80, 100);
  EXPECT_EQ(simulator_.statistics().undecodable, 1);
  RunUntil(11);
  EXPECT_EQ(states_.back().vehicles[0].command_sequence, 500);
}

TEST_F(SimulatorTest, CountsOfAFalseSessionThatWasHeardOnceEndWithIt) {
  Start(ScenarioOf(1));
  RunUntil(10);
  SendCommand(1, 1, 60, 1'000'000);
  for (std::int64_t sequence = 1; sequence <= 200; ++sequence) {
    RunUntil(10 + 0.05 * static_cast<double>(sequence));
    SendCommand(1, sequence, 65, 100);
  }
  EXPECT_GT(simulator_.statistics().undecodable, 0);
  EXPECT_LE(simulator_.statistics().undecodable, 42);
  EXPECT_EQ(simulator_.statistics().gaps, 0);
}

TEST_F(SimulatorTest, RefusesNothingOfWhatNetworksAndNewFlightsBring) {
  Start(ScenarioOf(1));
  RunUntil(0.5);
  SendCommand(1, 1, 80, 100, node_->start_utime() - 1);  // to the flight before
  for (const std::int64_t sequence : {1, 2, 2, 5, 4, 3, 6}) SendCommand(1, sequence, 60, 100);
  EXPECT_EQ(simulator_.statistics().undecodable, 0);
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

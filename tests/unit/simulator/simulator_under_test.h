#pragma once

#include <gtest/gtest.h>

#include <algorithm>
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
#include "simulator/simulator_node.h"

namespace skein::simulator {

using bus::SimulatedExecutor;
namespace channel = bus::channel;

inline config::Scenario ScenarioOf(int vehicles) {
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
    fleet_command_t command{};
    command.utime = executor_.Now();
    command.session_id = session_id;
    command.request_id = sequence;
    command.state_tick = state_tick_;
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
  std::int64_t state_tick_ = 0;  ///< of the state that commands answer
  std::int64_t payload_requests_ = 0;
};

}  // namespace skein::simulator

#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <numbers>
#include <skein/ack_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "controller/controller_node.h"
#include "unit/controller/flight_bench.h"

namespace skein::controller {

/// A controller on a bus, and a fleet that the test plays: UAV1 to UAV3 in their slots, UAV9 in no formation.
class ControllerNodeTest : public testing::Test {
 protected:
  ControllerNodeTest() {
    config::Scenario scenario;
    config::FormationConfig formation;
    formation.id = 1;
    formation.name = "Triangle";
    formation.shape = Shape::kTriangle;
    formation.spacing_m = 500;
    formation.leader = {0, 0, 1000, 50, std::numbers::pi / 2};
    const auto offsets = ShapeSlots(Shape::kTriangle, 3, 500);
    for (int id = 1; id <= 3; ++id)
      formation.slots.push_back({id, offsets[static_cast<std::size_t>(id - 1)]});
    scenario.formations.push_back(formation);
    for (const Slot& slot : formation.slots) {
      uavs_[slot.vehicle_id] = {
          -slot.offset.left_m, slot.offset.forward_m, 1000, 50, std::numbers::pi / 2, 0};
    }
    uavs_[9] = {20000, 0, 500, 45, 0, 0};
    options_.scenario = scenario;
    station_.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [this](const fleet_command_t& command) {
      ++command_messages_;
      for (const auto& one : command.commands) commands_[one.id] = one;
      last_ = command;
    });
    station_.Subscribe<ack_t>(bus::channel::kAck, [this](const ack_t& ack) { ack_ = ack; });
    station_.Subscribe<event_t>(bus::channel::kEvent,
                                [this](const event_t& event) { codes_.push_back(event.code); });
    station_.Subscribe<formation_t>(bus::channel::kFormation,
                                    [this](const formation_t& formation) { formation_ = formation; });
    station_.Subscribe<formation_status_t>(bus::channel::kFormationStatus,
                                           [this](const formation_status_t& status) { status_ = status; });
  }

  void Start() { node_ = std::make_unique<FormationControllerNode>(bus_, options_); }

  fleet_roster_t Roster(bus::Utime now, const std::string& scenario = "") const {
    fleet_roster_t roster{};
    roster.utime = now;
    roster.session_id = 1;
    roster.start_utime = start_utime_;
    roster.scenario = scenario;
    for (const auto& [id, uav] : uavs_)
      roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel(), true));
    roster.revision = 1;
    return roster;
  }
  void SendRoster(const std::string& scenario = "") {
    bus::PublishChunks(station_, bus::channel::kFleetRoster, Roster(executor_.Now(), scenario));
    executor_.Deliver();
  }

  /// Of all that are heard.
  fleet_state_t State(bus::Utime now, std::int64_t tick) const {
    fleet_state_t state{};
    state.utime = now;
    state.session_id = 1;
    state.tick = tick;
    for (const auto& [id, uav] : uavs_) {
      if (id == silent_) continue;
      vehicle_state_t vehicle = bus::ToMessage(uav);
      vehicle.utime = now;
      vehicle.id = id;
      vehicle.command_session_id = 0;
      vehicle.command_sequence = 0;
      vehicle.payload_on = 0;
      state.vehicles.push_back(vehicle);
    }
    return state;
  }

  void Fly(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      bus::PublishChunks(station_, bus::channel::kFleetState, State(executor_.Now() + clock_error_, tick_++));
      executor_.Deliver();
      for (auto& [id, uav] : uavs_) {
        const auto command = commands_.find(id);
        AutopilotInput input{uav.speed_m_s, uav.course_rad, 0};
        if (command != commands_.end()) {
          input = {command->second.speed_input_m_s, command->second.course_input_rad,
                   command->second.climb_input_rad};
        }
        uav = Step(uav, input, VehicleModel(), 0.05);
      }
      executor_.RunFor(FlightBench::kTick);
    }
  }

  formation_command_t Command(std::int8_t action) {
    formation_command_t command{};
    command.utime = executor_.Now();
    command.session_id = 77;
    command.request_id = ++request_id_;
    command.to_session_id = bus_.session_id();
    command.action = action;
    command.formation = formation_;
    return command;
  }

  ack_t Ask(const formation_command_t& command) {
    ack_ = {};
    station_.Publish(bus::channel::kCmdFormation, command);
    executor_.Deliver();
    return ack_;
  }

  bus::Transport transport_ = bus::MakeTransport("memq://");
  bus::SimulatedExecutor executor_{transport_.lcm};
  bus::Bus bus_{transport_.lcm, "formation-controller", executor_};
  bus::Bus station_{transport_.lcm, "test", executor_};
  ControllerOptions options_;
  std::unique_ptr<FormationControllerNode> node_;
  std::map<int, VehicleState> uavs_;
  bus::Utime start_utime_ = bus::SimulatedExecutor::kStart;
  std::int64_t tick_ = 0;
  bus::Utime clock_error_ = 0;
  int silent_ = 0;
  std::int64_t request_id_ = 0;
  int command_messages_ = 0;
  std::map<int, vehicle_command_t> commands_;
  fleet_command_t last_;
  ack_t ack_;
  formation_t formation_;
  formation_status_t status_;
  std::vector<std::string> codes_;
};

}  // namespace skein::controller

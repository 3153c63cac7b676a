#pragma once

#include <cstdint>
#include <map>
#include <skein/alarm_list_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/path_t.hpp>
#include <skein/proximity_t.hpp>
#include <string>
#include <vector>

#include "bridge/bus_mirror.h"
#include "bus/bus.h"
#include "bus/memory_transport.h"
#include "bus/simulated_executor.h"
#include "config/scenario.h"
#include "controller/controller_node.h"
#include "monitor/collision_monitor_node.h"
#include "simulator/simulator_node.h"

namespace skein::testing {

/// fleet-simulator, formation-controller, collision-monitor and what web-bridge knows, as they are live, on a
/// simulated clock; and somebody who hears all of them and may say anything.
class WholeNodes {
 public:
  WholeNodes();

  void Run(double seconds) { executor_.RunFor(bus::ToUtime(seconds)); }
  bus::Utime Now() const { return executor_.Now(); }

  template <typename Message>
  void Say(const std::string& channel, const Message& message) {
    liar_.Publish(channel, message);
    executor_.Deliver();
  }
  /// In chunks.
  template <typename Message>
  void SayAll(const std::string& channel, const Message& message);

  const simulator::FleetSimulatorNode& simulator() const { return simulator_; }
  const bridge::BusMirror& mirror() const { return mirror_; }
  /// Of all nodes: how many messages to them were refused, as their last HEARTBEAT says.
  std::map<std::string, std::int64_t> Refused() const;

  // The last of everything that they said.
  fleet_roster_t roster;
  fleet_state_t state;
  fleet_command_t command;
  formation_t formation;
  path_t path;
  formation_status_t status;
  link_status_t links;
  proximity_t proximity;
  alarm_list_t alarms;
  std::map<std::string, heartbeat_t> heartbeats;
  std::vector<event_t> events;
  int commands = 0;
  std::size_t frames = 0;  ///< to the page

 private:
  std::shared_ptr<lcm::LCM> transport_ = bus::MemoryTransport();
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus simulator_bus_{transport_, "fleet-simulator", executor_};
  bus::Bus controller_bus_{transport_, "formation-controller", executor_};
  bus::Bus monitor_bus_{transport_, "collision-monitor", executor_};
  bus::Bus bridge_bus_{transport_, "web-bridge", executor_};
  bus::Bus liar_{transport_, "liar", executor_};
  config::Scenario scenario_ = config::LoadScenario(config::FindScenario("turn"));
  simulator::FleetSimulatorNode simulator_{simulator_bus_, {.scenario = scenario_}};
  controller::FormationControllerNode controller_;
  monitor::CollisionMonitorNode monitor_;
  bridge::BusMirror mirror_{
      bridge_bus_, {"", "memq://", "", ""}, [this](const bridge::LiveFrame&) { ++frames; }};
};

}  // namespace skein::testing

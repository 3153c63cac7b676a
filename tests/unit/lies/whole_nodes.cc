#include "unit/lies/whole_nodes.h"

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/heartbeat.h"
#include "bus/refusals.h"
#include "monitor/scenario_options.h"

namespace skein::testing {
namespace {

namespace channel = bus::channel;

controller::ControllerOptions OptionsOf(const config::Scenario& scenario) {
  controller::ControllerOptions options;
  options.scenario = scenario;
  return options;
}

}  // namespace

WholeNodes::WholeNodes()
    : controller_(controller_bus_, OptionsOf(scenario_)),
      monitor_(monitor_bus_, monitor::OptionsOf(scenario_)) {
  for (bus::Bus* bus : {&simulator_bus_, &controller_bus_, &monitor_bus_, &bridge_bus_, &liar_})
    bus->SetLogs(false);
  for (bus::Bus* bus : {&simulator_bus_, &controller_bus_, &monitor_bus_, &bridge_bus_}) {
    bus::StartHeartbeat(*bus);
    bus::TellRefusals(*bus);
  }
  // Whatever is said is heard here as it comes: what is false of it the tests say themselves.
  const auto keep = [this](const char* name, auto& last) {
    liar_.Subscribe<std::remove_reference_t<decltype(last)>>(
        name, [&last](const auto& message) { last = message; });
  };
  keep(channel::kFleetRoster, roster);
  keep(channel::kFleetState, state);
  keep(channel::kFormation, formation);
  keep(channel::kPath, path);
  keep(channel::kFormationStatus, status);
  keep(channel::kLinkStatus, links);
  keep(channel::kProximity, proximity);
  keep(channel::kAlarms, alarms);
  liar_.Subscribe<fleet_command_t>(channel::kCmdFleet, [this](const fleet_command_t& heard) {
    command = heard;
    ++commands;
  });
  liar_.Subscribe<heartbeat_t>(channel::kHeartbeat, [this](const heartbeat_t& heartbeat) {
    heartbeats[heartbeat.heartbeat_node] = heartbeat;
  });
  liar_.Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { events.push_back(event); });
}

template <typename Message>
void WholeNodes::SayAll(const std::string& channel, const Message& message) {
  for (const Message& chunk : bus::Split(message)) Say(channel, chunk);
}
template void WholeNodes::SayAll(const std::string&, const fleet_state_t&);
template void WholeNodes::SayAll(const std::string&, const fleet_roster_t&);

std::map<std::string, std::int64_t> WholeNodes::Refused() const {
  std::map<std::string, std::int64_t> refused;
  for (const auto& [node, heartbeat] : heartbeats) refused[node] = heartbeat.undecodable;
  return refused;
}

}  // namespace skein::testing

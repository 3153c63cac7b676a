// A controller of many formations does not send everything at once: bursts overflow receive buffers.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "controller/controller_node.h"
#include "unit/controller/flight_bench.h"

namespace skein::controller {
namespace {

constexpr int kFormations = 40;
constexpr int kTicks = 20;

/// Formations of one UAV each.
config::Scenario ManyFormations() {
  config::Scenario scenario;
  for (int id = 1; id <= kFormations; ++id) {
    config::FormationConfig formation;
    formation.id = id;
    formation.name = "Formation " + std::to_string(id);
    formation.leader = {1000. * id, 0, 1000, 50, std::numbers::pi / 2};
    formation.slots = {{id, {}}};
    scenario.formations.push_back(formation);
  }
  return scenario;
}

int Most(const std::map<bus::Utime, int>& by_time) {
  int most = 0;
  for (const auto& [utime, count] : by_time) most = std::max(most, count);
  return most;
}
int Sum(const std::map<bus::Utime, int>& by_time) {
  int sum = 0;
  for (const auto& [utime, count] : by_time) sum += count;
  return sum;
}

TEST(ControllerOfManyFormations, SpreadsWhatItSendsOverItsPeriod) {
  const bus::Transport transport = bus::MakeTransport("memq://");
  bus::SimulatedExecutor executor(transport.lcm);
  bus::Bus bus(transport.lcm, "formation-controller", executor);
  bus::Bus fleet(transport.lcm, "fleet-simulator", executor);
  ControllerOptions options;
  options.scenario = ManyFormations();
  FormationControllerNode controller(bus, options);
  std::map<bus::Utime, int> formations, statuses;
  std::map<int, int> formations_of, statuses_of;
  fleet.Subscribe<formation_t>(bus::channel::kFormation, [&](const formation_t& formation) {
    ++formations[executor.Now()];
    ++formations_of[formation.formation_id];
  });
  fleet.Subscribe<formation_status_t>(bus::channel::kFormationStatus, [&](const formation_status_t& status) {
    ++statuses[executor.Now()];
    ++statuses_of[status.formation_id];
  });

  fleet_roster_t roster{};
  roster.utime = roster.start_utime = executor.Now();
  roster.session_id = roster.revision = 1;
  fleet_state_t state{};
  state.session_id = 1;
  for (int id = 1; id <= kFormations; ++id) {
    roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel(), false));
    state.vehicles.push_back(bus::ToMessage(VehicleState{1000. * id, 0, 1000, 50, std::numbers::pi / 2, 0}));
    state.vehicles.back().id = id;
  }
  bus::PublishChunks(fleet, bus::channel::kFleetRoster, roster);
  executor.Deliver();
  // Planning takes long: the bus is read in between, and nothing is taken from those that wait.
  EXPECT_EQ(controller.flights().size(), 10u);
  formation_command_t hold{};
  hold.to_session_id = bus.session_id();
  hold.request_id = 1;
  hold.action = formation_command_t::ACTION_HOLD;
  hold.formation.formation_id = 1;
  std::string answer;
  fleet.Subscribe<ack_t>(bus::channel::kAck, [&](const ack_t& ack) { answer = ack.reason; });
  fleet.Publish(bus::channel::kCmdFormation, hold);
  executor.Deliver();
  EXPECT_EQ(answer, "30 formations of the scenario are still to be started: try again in 1 s");
  executor.RunFor(bus::kSecond);
  EXPECT_EQ(controller.flights().size(), static_cast<std::size_t>(kFormations));
  formations.clear();
  formations_of.clear();
  for (int tick = 0; tick < kTicks; ++tick) {
    state.tick = tick;
    state.utime = executor.Now();
    for (vehicle_state_t& vehicle : state.vehicles) vehicle.utime = state.utime;
    bus::PublishChunks(fleet, bus::channel::kFleetState, state);
    executor.RunFor(FlightBench::kTick);
  }

  EXPECT_EQ(Sum(formations), kFormations) << "each once a second";
  EXPECT_EQ(formations_of.size(), static_cast<std::size_t>(kFormations));
  EXPECT_LE(Most(formations), kFormations / 20);
  EXPECT_EQ(Sum(statuses), kFormations * kTicks / 8) << "five a tick, each every eight ticks";
  EXPECT_EQ(statuses_of.size(), static_cast<std::size_t>(kFormations));
  EXPECT_LE(Most(statuses), 5);
}

}  // namespace
}  // namespace skein::controller

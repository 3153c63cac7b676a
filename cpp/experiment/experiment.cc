#include "experiment/experiment.h"

#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/proximity_t.hpp>
#include <unordered_map>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/heartbeat.h"
#include "bus/log_writer.h"
#include "bus/memory_transport.h"
#include "monitor/collision_monitor_node.h"
#include "monitor/scenario_options.h"
#include "simulator/simulator_node.h"

namespace skein::experiment {
namespace {

constexpr bus::Utime kStep = simulator::FleetSimulatorNode::kPeriod;

Link ToLink(std::int8_t state, Link unknown) {
  switch (state) {
    case link_status_t::LINK_UP:
      return Link::kUp;
    case link_status_t::LINK_LATE:
      return Link::kLate;
    case link_status_t::LINK_LOST:
      return Link::kLost;
    default:
      return unknown;
  }
}

/// Hears what the nodes say, and keeps the last of everything.
class Listener {
 public:
  explicit Listener(bus::Bus& bus) {
    bus::SubscribeChunks<fleet_state_t>(bus, bus::channel::kFleetState,
                                        [this](const fleet_state_t& state, int) {
                                          for (const auto& vehicle : state.vehicles)
                                            vehicles[vehicle.id].heard_utime = vehicle.utime;
                                        });
    bus::SubscribeChunks<fleet_command_t>(bus, bus::channel::kCmdFleet,
                                          [this](const fleet_command_t& message, int) {
                                            for (const auto& command : message.commands)
                                              vehicles[command.id].command = command;
                                          });
    bus::SubscribeChunks<formation_status_t>(bus, bus::channel::kFormationStatus,
                                             [this](const formation_status_t& status, int) { Hear(status); });
    bus::SubscribeChunks<link_status_t>(bus, bus::channel::kLinkStatus,
                                        [this](const link_status_t& status, int) {
                                          for (const auto& link : status.links) Hear(link);
                                        });
    bus::SubscribeChunks<proximity_t>(bus, bus::channel::kProximity, [this](const proximity_t& sweep, int) {
      for (const auto& vehicle : sweep.vehicles) vehicles[vehicle.id].proximity = vehicle;
    });
    bus.Subscribe<event_t>(bus::channel::kEvent, [this](const event_t& event) { events.push_back(event); });
  }

  /// Forgets what belongs to one control step only.
  void BeginStep() {
    for (auto& [id, vehicle] : vehicles) {
      vehicle.heard_utime.reset();
      vehicle.command.reset();
      vehicle.slot.reset();
      vehicle.formation_id = 0;
    }
    formations.clear();
    events.clear();
  }

  std::unordered_map<int, VehicleTick> vehicles;  ///< but for what is true of them
  std::map<int, formation_status_t> formations;
  std::vector<event_t> events;

 private:
  void Hear(const formation_status_t& status) {
    for (const slot_status_t& slot : status.slots) {
      VehicleTick& vehicle = vehicles[slot.vehicle_id];
      vehicle.formation_id = status.formation_id;
      vehicle.slot = slot;
    }
    formations[status.formation_id] = status;
  }

  void Hear(const vehicle_link_t& link) {
    // A UAV that was never heard is lost; an uplink that nobody uses is as good as up.
    vehicles[link.id].downlink = ToLink(link.downlink, Link::kLost);
    vehicles[link.id].uplink = ToLink(link.uplink, Link::kUp);
  }
};

void AddTruth(const simulator::SimulatedVehicle& vehicle, VehicleTick& tick) {
  tick.id = vehicle.id();
  tick.truth = vehicle.state();
  tick.payload_on = vehicle.payload_on();
  tick.uplink_cut = vehicle.uplink().mode != simulator::LinkMode::kUp;
  tick.downlink_cut = vehicle.downlink().mode != simulator::LinkMode::kUp;
}

}  // namespace

struct Experiment::Impl {
  Impl(const config::Scenario& scenario, const ExperimentOptions& options)
      : transport(bus::MemoryTransport()),
        executor(transport, options.start),
        simulator_bus(transport, "fleet-simulator", executor),
        controller_bus(transport, "formation-controller", executor),
        monitor_bus(transport, "collision-monitor", executor),
        operator_bus(transport, "flight-experiment", executor),
        log(options.log.empty() ? nullptr
                                : std::make_unique<bus::LogWriter>(transport, executor, options.log)),
        // The simulator first: what happens at one instant happens in the order in which the nodes were made.
        simulator(simulator_bus, {.scenario = scenario, .seed = options.seed}),
        controller(controller_bus, {.scenario = scenario,
                                    .find_scenario = {},
                                    .status_every_ticks = 1,
                                    .state_file = {},
                                    .state = options.formations}),
        listener(operator_bus),
        start(executor.Now()) {
    for (bus::Bus* node : {&simulator_bus, &controller_bus, &monitor_bus, &operator_bus}) {
      node->SetLogs(options.logs);
    }
    if (options.monitor) monitor.emplace(monitor_bus, monitor::OptionsOf(scenario));
    for (bus::Bus* node : {&simulator_bus, &controller_bus, &monitor_bus}) bus::StartHeartbeat(*node);
    if (options.on_start) options.on_start(operator_bus);
  }

  std::shared_ptr<lcm::LCM> transport;
  bus::SimulatedExecutor executor;
  bus::Bus simulator_bus;
  bus::Bus controller_bus;
  bus::Bus monitor_bus;
  bus::Bus operator_bus;
  std::unique_ptr<bus::LogWriter> log;
  simulator::FleetSimulatorNode simulator;
  controller::FormationControllerNode controller;
  std::optional<monitor::CollisionMonitorNode> monitor;
  Listener listener;
  bus::Utime start;
  std::int64_t next_step = 0;
  Tick tick;
};

Experiment::Experiment(const config::Scenario& scenario, const ExperimentOptions& options)
    : impl_(std::make_unique<Impl>(scenario, options)) {}

Experiment::~Experiment() = default;

const Tick& Experiment::Step() {
  Impl& impl = *impl_;
  impl.listener.BeginStep();
  Tick& tick = impl.tick;
  tick.number = impl.next_step++;
  tick.utime = impl.start + tick.number * kStep;
  tick.t_s = bus::ToSeconds(tick.utime - impl.start);
  impl.executor.RunUntil(tick.utime);

  tick.vehicles.clear();
  for (const auto& vehicle : impl.simulator.fleet()) {
    AddTruth(vehicle, tick.vehicles.emplace_back(impl.listener.vehicles[vehicle.id()]));
  }
  tick.formations.swap(impl.listener.formations);
  tick.events.swap(impl.listener.events);
  if (impl.log) impl.log->Flush();
  return tick;
}

bus::Bus& Experiment::operator_bus() { return impl_->operator_bus; }
const controller::FormationControllerNode& Experiment::controller() const { return impl_->controller; }

std::int64_t StepsIn(double duration_s) {
  return static_cast<std::int64_t>(std::floor(duration_s / bus::ToSeconds(kStep) + 1e-6)) + 1;
}

Summary RunExperiment(const config::Scenario& scenario, const ExperimentOptions& options) {
  Experiment experiment(scenario, options);
  SummaryBuilder summary(scenario);
  const std::int64_t steps = StepsIn(options.duration_s.value_or(scenario.duration_s));
  for (std::int64_t step = 0; step < steps; ++step) {
    const Tick& tick = experiment.Step();
    summary.Add(tick);
    if (options.on_tick) options.on_tick(tick);
    if (options.stop && options.stop()) break;
  }
  return summary.Finish();
}

config::Scenario UnderControl(config::Scenario scenario, const std::string& control) {
  for (config::FormationConfig& formation : scenario.formations) {
    if (formation.control != control) formation.gains.clear();
    formation.control = control;
  }
  return scenario;
}

}  // namespace skein::experiment

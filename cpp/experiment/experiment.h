#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bus/bus.h"
#include "bus/simulated_executor.h"
#include "config/scenario.h"
#include "controller/controller_node.h"
#include "experiment/summary.h"
#include "experiment/tick.h"

namespace skein::experiment {

struct ExperimentOptions {
  std::optional<double> duration_s;                   ///< the scenario's own when empty
  std::uint64_t seed = 1;                             ///< of lossy and jittered links
  bus::Utime start = bus::SimulatedExecutor::kStart;  ///< of the simulated clock, t = 0
  /// Formations in flight that the controller goes on with, instead of the scenario's.
  std::optional<controller::ControllerState> formations;
  bool monitor = true;        ///< false: no collision-monitor; LINK_STATUS is for the operator's bus to send
  bool logs = true;           ///< whether events go into this process's log
  std::filesystem::path log;  ///< LCM log of everything on the bus; "" for none
  std::function<void(const Tick&)> on_tick;  ///< called after each control step
  std::function<bool()> stop;                ///< asked after each control step; true ends the flight early
  /// Called before the first control step with the bus of an operator, to send CMD_* (at once, or later by
  /// bus.executor().At) and to hear what the nodes say.
  std::function<void(bus::Bus&)> on_start;
};

/// Simulator, controller and monitor in one process over memq:// on a simulated clock: as fast as it can,
/// without sleeping, and the same on every run. Several may fly at once, a thread each: they share nothing.
class Experiment {
 public:
  /// Throws what the nodes throw for a scenario that cannot be flown, and std::runtime_error for a log that
  /// cannot be written.
  Experiment(const config::Scenario& scenario, const ExperimentOptions& options);
  ~Experiment();
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;

  /// Flies one control step of 50 ms; the first one is t = 0.
  const Tick& Step();

  /// An operator's view of the bus.
  bus::Bus& operator_bus();
  const controller::FormationControllerNode& controller() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How many control steps a flight of this duration has: one at t = 0, one at its end.
std::int64_t StepsIn(double duration_s);

/// Flies a scenario from start to end.
Summary RunExperiment(const config::Scenario& scenario, const ExperimentOptions& options = {});

/// The scenario with all formations under another control. Gains belong to a control: those of another one
/// are dropped.
config::Scenario UnderControl(config::Scenario scenario, const std::string& control);

}  // namespace skein::experiment

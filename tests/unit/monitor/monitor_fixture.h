#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "bus/transport.h"
#include "monitor/collision_monitor_node.h"
#include "unit/monitor/fake_fleet.h"

namespace skein::monitor::testing {

/// A monitor that hears a fake fleet on a simulated clock.
class MonitorTest : public ::testing::Test {
 protected:
  /// Starts the monitor; the fleet may have been flying for long. (That is all that a restart is without a
  /// state file: it keeps nothing.)
  void Start(const CollisionMonitorOptions& options = {}) { node_.emplace(monitor_bus_, options); }
  void Run(double seconds) { executor_.RunFor(bus::ToUtime(seconds)); }

  std::shared_ptr<lcm::LCM> transport_ = bus::MakeTransport("memq://").lcm;
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus station_{transport_, "station", executor_};
  FakeFleet fleet_{station_};
  Listener heard_{station_};
  bus::Bus monitor_bus_{transport_, "collision-monitor", executor_};
  std::optional<CollisionMonitorNode> node_;
};

}  // namespace skein::monitor::testing

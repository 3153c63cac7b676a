#pragma once

#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <thread>

#include "bridge/web_bridge.h"
#include "bus/bus.h"
#include "bus/live_executor.h"

namespace skein::bridge {

/// A bridge on a free port of the loopback interface and a bus of its own, with another node to talk to it.
class BridgeUnderTest {
 public:
  explicit BridgeUnderTest(BridgeOptions options = {});
  ~BridgeUnderTest();

  std::uint16_t port() const { return bridge_->port(); }

  /// Runs on the bus's thread, with the other node's view of the bus; returns when it has run.
  void OnBus(const std::function<void(bus::Bus& other)>& action);

 private:
  std::shared_ptr<lcm::LCM> transport_ = std::make_shared<lcm::LCM>("memq://");
  bus::LiveExecutor executor_{transport_};
  bus::Bus bus_{transport_, "web-bridge", executor_};
  bus::Bus other_{transport_, "fleet-simulator", executor_};
  std::unique_ptr<WebBridge> bridge_;
  std::thread thread_;
};

/// Two UAVs where they were last heard.
fleet_roster_t TwoVehicles();
void SendTwoVehicles(bus::Bus& bus);

}  // namespace skein::bridge

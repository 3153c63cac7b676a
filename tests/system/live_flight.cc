#include "system/live_flight.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <skein/fleet_state_t.hpp>

#include "bus/channels.h"
#include "system/bus_ear.h"

namespace skein::testing {
namespace {

constexpr double kTickS = 0.05;

}  // namespace

LiveFlight::LiveFlight(const std::string& scenario, const std::string& log) {
  recorder_ =
      std::make_unique<Process>(std::vector<std::string>{"lcm-logger", "--quiet", "--lcm-url=" + url_, log});
  const auto start = [&](const std::string& node) {
    nodes_.push_back(std::make_unique<Process>(
        std::vector<std::string>{Program(node), "--lcm-url", url_, "--scenario", scenario}));
    EXPECT_TRUE(HearsHeartbeat(url_, node)) << nodes_.back()->output();
  };
  start("collision-monitor");
  start("formation-controller");
  start("fleet-simulator");
}

bool LiveFlight::WaitUntil(double t_s, Seconds timeout) {
  return Hears<fleet_state_t>(
      url_, bus::channel::kFleetState,
      [&](const fleet_state_t& state) { return static_cast<double>(state.tick) * kTickS >= t_s; }, timeout);
}

bool LiveFlight::End() {
  using namespace std::chrono_literals;
  bool clean = true;
  for (const auto& node : nodes_) node->Signal(SIGTERM);
  for (const auto& node : nodes_) clean = node->WaitForEnd(5s) == 0 && clean;
  recorder_->Signal(SIGTERM);
  return recorder_->WaitForEnd(5s) == 0 && clean;
}

}  // namespace skein::testing

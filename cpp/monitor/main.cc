#include <memory>
#include <optional>
#include <string>

#include "bus/node_main.h"
#include "config/scenario.h"
#include "monitor/collision_monitor_node.h"
#include "monitor/scenario_options.h"

int main(int argc, char** argv) {
  using namespace skein;  // NOLINT: the main file of a program
  bus::NodeMain node("collision-monitor", "Warns of collisions and watches the data links of a fleet.");
  std::string scenario;
  std::string state_file;
  int rate_hz = 1;
  monitor::CollisionMonitorOptions options;
  node.app().add_option("--scenario", scenario,
                        "Scenario with formations and thresholds: a file, or the name of one that ships");
  node.app()
      .add_option("--rate-hz", rate_hz, "Sweeps for collisions per second")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  node.app().add_option(
      "--state-file", state_file,
      "Keeps the alarms and when each UAV was heard here, to go on with after a restart within a minute");
  node.OnlyOne([&] {
    if (!scenario.empty()) {
      const auto file = config::FindScenario(scenario);
      options = monitor::OptionsOf(config::LoadScenario(file));
      options.find_options = [file](const std::string& name) {
        const auto found = config::ReadScenarioOfFleet(name, file);
        return found ? std::optional(monitor::OptionsOf(*found)) : std::nullopt;
      };
    }
    options.rate_hz = rate_hz;
    options.state_file = state_file;
  });
  return node.Run(argc, argv, [&](bus::Bus& bus, bus::LiveExecutor&) {
    return std::make_shared<monitor::CollisionMonitorNode>(bus, options);
  });
}

#include <memory>
#include <optional>
#include <string>

#include "bus/node_main.h"
#include "config/scenario.h"
#include "monitor/collision_monitor_node.h"
#include "monitor/scenario_options.h"

int main(int argc, char** argv) {
  skein::bus::NodeMain node("collision-monitor",
                            "Warns of collisions and watches the data links of a fleet.");
  std::string scenario;
  int rate_hz = 1;
  node.app().add_option("--scenario", scenario,
                        "Scenario with formations and thresholds: a file, or the name of one that ships");
  node.app()
      .add_option("--rate-hz", rate_hz, "Sweeps for collisions per second")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  return node.Run(argc, argv, [&](skein::bus::Bus& bus, skein::bus::LiveExecutor&) {
    skein::monitor::CollisionMonitorOptions options;
    if (!scenario.empty()) {
      const auto file = skein::config::FindScenario(scenario);
      options = skein::monitor::OptionsOf(skein::config::LoadScenario(file));
      options.find_options = [file](const std::string& name) {
        const auto found = skein::config::ReadScenarioOfFleet(name, file);
        return found ? std::optional(skein::monitor::OptionsOf(*found)) : std::nullopt;
      };
    }
    options.rate_hz = rate_hz;
    return std::make_shared<skein::monitor::CollisionMonitorNode>(bus, options);
  });
}

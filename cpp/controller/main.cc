#include "bus/node_main.h"
#include "controller/controller_node.h"

int main(int argc, char** argv) {
  skein::bus::NodeMain node(
      "formation-controller",
      "Flies formations: virtual leaders along paths, a law for each UAV, avoidance when a link is lost.");
  std::string scenario;
  std::string state_file;
  node.app().add_option("--scenario", scenario,
                        "Scenario with the formations to start with: a file, or the name of one that ships");
  node.app().add_option(
      "--state-file", state_file,
      "Keeps the state of all formations here, to go on with after a restart in the same flight");
  return node.Run(argc, argv, [&](skein::bus::Bus& bus, skein::bus::LiveExecutor&) {
    skein::controller::ControllerOptions options;
    if (!scenario.empty()) {
      const auto file = skein::config::FindScenario(scenario);
      options.scenario = skein::config::LoadScenario(file);
      options.find_scenario = [file](const std::string& name) {
        return skein::config::ReadScenarioOfFleet(name, file);
      };
    }
    options.state_file = state_file;
    return std::make_shared<skein::controller::FormationControllerNode>(bus, options);
  });
}

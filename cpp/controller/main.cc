#include "bus/node_main.h"
#include "controller/controller_node.h"

int main(int argc, char** argv) {
  using namespace skein;  // NOLINT: the main file of a program
  bus::NodeMain node(
      "formation-controller",
      "Flies formations: virtual leaders along paths, a law for each UAV, avoidance when a link is lost.");
  std::string scenario;
  std::string state_file;
  controller::ControllerOptions options;
  node.app().add_option("--scenario", scenario,
                        "Scenario with the formations to start with: a file, or the name of one that ships");
  node.app().add_option(
      "--state-file", state_file,
      "Keeps the state of all formations here, to go on with after a restart in the same flight");
  node.OnlyOne([&] {
    options.state_file = state_file;
    if (scenario.empty()) return;
    const auto file = config::FindScenario(scenario);
    options.scenario = config::LoadScenario(file);
    options.find_scenario = [file](const std::string& name) {
      return config::ReadScenarioOfFleet(name, file);
    };
  });
  return node.Run(argc, argv, [&](bus::Bus& bus, bus::LiveExecutor&) {
    return std::make_shared<controller::FormationControllerNode>(bus, options);
  });
}

#include <cstdint>
#include <memory>
#include <string>

#include "bus/node_main.h"
#include "config/scenario.h"
#include "simulator/simulator_node.h"

int main(int argc, char** argv) {
  using namespace skein;  // NOLINT: the main file of a program
  bus::NodeMain node("fleet-simulator", "Flies a fleet of simulated UAVs with their data links.");
  std::string scenario;
  simulator::SimulatorOptions options;
  std::string state_file;
  node.app().add_option("--scenario", scenario, "Scenario file, or the name of one that ships")->required();
  node.app()
      .add_option("--seed", options.seed, "Seed of lossy and jittered data links")
      ->capture_default_str();
  node.app().add_option(
      "--state-file", state_file,
      "Keeps the flight here, to go on with it when this process is started again within a minute");
  node.OnlyOne([&] {
    options.scenario = config::LoadScenario(config::FindScenario(scenario));
    options.state_file = state_file;
  });
  return node.Run(argc, argv, [&](bus::Bus& bus, auto&) {
    return std::make_shared<simulator::FleetSimulatorNode>(bus, options);
  });
}

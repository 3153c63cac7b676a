#include <cstdint>
#include <memory>
#include <string>

#include "bus/node_main.h"
#include "config/scenario.h"
#include "simulator/simulator_node.h"

int main(int argc, char** argv) {
  skein::bus::NodeMain node("fleet-simulator", "Flies a fleet of simulated UAVs with their data links.");
  std::string scenario;
  std::uint64_t seed = 1;
  node.app().add_option("--scenario", scenario, "Scenario file, or the name of one that ships")->required();
  node.app().add_option("--seed", seed, "Seed of lossy and jittered data links")->capture_default_str();
  return node.Run(argc, argv, [&](skein::bus::Bus& bus, auto&) {
    using namespace skein;
    return std::make_shared<simulator::FleetSimulatorNode>(
        bus, simulator::SimulatorOptions{config::LoadScenario(config::FindScenario(scenario)), seed});
  });
}

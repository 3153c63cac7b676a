#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>
#include <string>

#include "bus/node_main.h"
#include "bus/number_checks.h"
#include "config/scenario.h"
#include "recorder/flight_recorder_node.h"

namespace {

using namespace skein;  // NOLINT: the main file of a program

/// Recordings are named after the file of a scenario, not after its title, where the file is known.
std::string StemOf(const std::string& title, const std::string& own_title, const std::string& own_stem) {
  if (!own_title.empty() && title == own_title) return own_stem;
  return recorder::FileStem(config::BareNameOf(title).value_or(title));
}

// More than any disk holds; in bytes still well below 2^63.
constexpr double kMostGb = 1e9;

}  // namespace

int main(int argc, char** argv) {
  bus::NodeMain node("flight-recorder", "Has lcm-logger record the bus, and says whether that goes well.");
  std::string folder = "logs";
  std::string scenario;
  double split_mb = 256;
  double quota_gb = 10;
  double keep_free_gb = 1;
  CLI::App& app = node.app();
  app.add_option("--folder", folder, "Where recordings go")->capture_default_str()->take_last();
  app.add_option(
      "--scenario", scenario,
      "Scenario that will fly, for the recording's name until a fleet is heard: a file, or the name of one "
      "that ships");
  app.add_option("--split-mb", split_mb, "A file that is so large is followed by another one [MB]")
      ->check(bus::Between(0.1, 1e6))
      ->capture_default_str();
  app.add_option(
         "--quota-gb", quota_gb,
         "All recordings of the folder together; beyond it the oldest are removed, if flight-recorder wrote "
         "them [GB]")
      ->check(bus::Between(0, kMostGb))
      ->capture_default_str();
  app.add_option("--keep-free-gb", keep_free_gb, "So much of the disk stays free, whatever happens [GB]")
      ->check(bus::Between(0, kMostGb))
      ->capture_default_str();
  // Two would record everything twice, and contradict one another about whether it is recorded.
  node.OnlyOne([] {});
  return node.Run(argc, argv, [&](bus::Bus& bus, bus::LiveExecutor& executor) {
    recorder::FlightRecorderOptions options;
    options.folder = folder;
    options.lcm_url = node.lcm_url();
    options.split_bytes = std::llround(split_mb * 1e6);
    options.room = {std::llround(quota_gb * 1e9), std::llround(keep_free_gb * 1e9)};
    std::string stem;
    if (!scenario.empty()) {
      const auto file = config::FindScenario(scenario);
      options.scenario = config::LoadScenario(file).name;
      stem = recorder::FileStem(file.stem().string());
    }
    options.stem_of = [own = options.scenario, stem](const std::string& title) {
      return StemOf(title, own, stem);
    };
    return std::make_shared<recorder::FlightRecorderNode>(bus, executor, options);
  });
}

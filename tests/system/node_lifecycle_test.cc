// Every program by itself: what it says of itself, what it makes of bad input, how it ends.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "system/bus_ear.h"
#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

std::string Triangle() { return std::string(SKEIN_SOURCE_DIR) + "/scripts/scenarios/triangle.json"; }

class EveryProgram : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryProgram, ExplainsItself) {
  const Finished help = RunToEnd({Program(GetParam()), "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("--"), std::string::npos) << help.output;
}

TEST_P(EveryProgram, TellsItsVersion) {
  const Finished version = RunToEnd({Program(GetParam()), "--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_NE(version.output.find(SKEIN_VERSION), std::string::npos) << version.output;
}

TEST_P(EveryProgram, RefusesAnUnknownOptionWithExitCode2) {
  const Finished refused = RunToEnd({Program(GetParam()), "--no-such-option"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("--help"), std::string::npos) << refused.output;  // what to do about it
}

INSTANTIATE_TEST_SUITE_P(Skein, EveryProgram,
                         ::testing::Values("fleet-simulator", "formation-controller", "collision-monitor",
                                           "web-bridge", "flight-recorder", "flight-experiment", "skein"));

class ScenarioReader : public ::testing::TestWithParam<std::string> {
 protected:
  /// The command that makes the program read this scenario.
  static std::vector<std::string> Reading(const std::string& scenario) {
    if (GetParam() == "flight-experiment") return {Program(GetParam()), scenario};
    return {Program(GetParam()), "--lcm-url", FreshLcmUrl(), "--scenario", scenario};
  }
};

TEST_P(ScenarioReader, RefusesAMissingFileWithExitCode2) {
  const Finished refused = RunToEnd(Reading("/no/such/scenario.json"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("/no/such/scenario.json"), std::string::npos) << refused.output;
}

TEST_P(ScenarioReader, NamesTheFileAndThePathOfWhatIsWrongWithExitCode2) {
  const std::string file = FreshFolder("skein-scenario") + "/bad.json";
  std::ofstream(file)
      << R"({"name": "bad", "origin": {"latitude_deg": 0, "longitude_deg": 0, "altitude_m": 0},
                             "vehicles": [{"id": 1, "callsign": "UAV1", "east_m": 0, "north_m": 0, "up_m": 500,
                                           "speed_m_s": "fast", "course_deg": 0}]})";
  const Finished refused = RunToEnd(Reading(file));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find(file), std::string::npos) << refused.output;
  EXPECT_NE(refused.output.find("/vehicles/0/speed_m_s"), std::string::npos) << refused.output;
  std::filesystem::remove_all(std::filesystem::path(file).parent_path());
}

INSTANTIATE_TEST_SUITE_P(Skein, ScenarioReader,
                         ::testing::Values("fleet-simulator", "formation-controller", "collision-monitor",
                                           "flight-experiment"));

struct NodeAndSignal {
  std::string node;
  int signal;
};

void PrintTo(const NodeAndSignal& both, std::ostream* out) {
  *out << both.node << " and " << (both.signal == SIGINT ? "SIGINT" : "SIGTERM");
}

class EveryNode : public ::testing::TestWithParam<NodeAndSignal> {};

TEST_P(EveryNode, EndsCleanlyOnASignal) {
  const std::string url = FreshLcmUrl();
  std::vector<std::string> command{Program(GetParam().node), "--lcm-url", url};
  if (GetParam().node == "web-bridge") {
    command.insert(command.end(), {"--port", std::to_string(FreeTcpPort())});
  } else {
    command.insert(command.end(), {"--scenario", Triangle()});
  }
  Process node(command);
  ASSERT_TRUE(HearsHeartbeat(url, GetParam().node)) << node.output();
  node.Signal(GetParam().signal);
  EXPECT_EQ(node.WaitForEnd(5s), 0) << node.output();
}

std::vector<NodeAndSignal> NodesAndSignals() {
  std::vector<NodeAndSignal> both;
  for (const char* node : {"fleet-simulator", "formation-controller", "collision-monitor", "web-bridge"}) {
    both.push_back({node, SIGINT});
    both.push_back({node, SIGTERM});
  }
  return both;
}

INSTANTIATE_TEST_SUITE_P(Skein, EveryNode, ::testing::ValuesIn(NodesAndSignals()), [](const auto& named) {
  std::string name = named.param.node + (named.param.signal == SIGINT ? "_SIGINT" : "_SIGTERM");
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace skein::testing

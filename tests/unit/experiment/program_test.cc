// flight-experiment as its users start it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <ostream>
#include <skein/fleet_state_t.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "system/process.h"

namespace skein::experiment {
namespace {

using testing::Finished;
using testing::RunToEnd;

const std::string kProgram = SKEIN_BIN_DIR "/flight-experiment";
const std::string kScenarios = SKEIN_SOURCE_DIR "/scripts/scenarios/";

class FlightExperiment : public ::testing::Test {
 protected:
  FlightExperiment() : folder_(testing::FreshFolder("skein-experiment")) {}
  ~FlightExperiment() override { std::filesystem::remove_all(folder_); }

  std::string File(const std::string& name) const { return folder_ + "/" + name; }

  static std::string Contents(const std::string& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  static Finished Fly(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), kProgram);
    return RunToEnd(arguments, testing::Seconds(120));
  }

 private:
  std::string folder_;
};

/// The only line that may differ from run to run.
std::string WithoutRealTime(const std::string& output) {
  std::string result;
  std::stringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  Real time: ", 0) != 0) result += line + "\n";
  }
  return result;
}

TEST_F(FlightExperiment, WritesTheSameBytesOnEveryRun) {
  // Losses and jitter, so that random numbers count, and a link drop.
  std::ofstream(File("lossy.json"))
      << R"({"name": "Lossy", "origin": {"latitude_deg": 40, "longitude_deg": 116},
    "link": {"up": {"loss": 0.1, "delay_s": 0.1}, "down": {"loss": 0.1, "jitter_s": 0.2}},
    "formations": [{"id": 1, "shape": "triangle", "vehicles": [1, 2, 3],
      "leader": {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}}],
    "vehicles": [
      {"id": 1, "east_m": 0, "north_m": -1500, "up_m": 1000, "speed_m_s": 50, "course_deg": 0},
      {"id": 2, "east_m": -900, "north_m": -1500, "up_m": 1000, "speed_m_s": 50, "course_deg": 0},
      {"id": 3, "east_m": 900, "north_m": -1500, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}],
    "timeline": [{"at_s": 10, "cut_link": 3, "for_s": 10}]})";
  std::vector<std::string> outputs;
  for (const std::string run : {"one", "two"}) {
    const Finished flown =
        Fly({File("lossy.json"), "--duration", "40", "--control", "paper,skein", "--csv", File(run + ".csv"),
             "--log", File(run + ".lcm"), "--plot", File(run + ".svg")});
    ASSERT_EQ(flown.exit_code, 0) << flown.output;
    outputs.push_back(WithoutRealTime(flown.output));
  }
  EXPECT_EQ(outputs[0], outputs[1]);
  for (const std::string name : {"-paper.csv", "-skein.csv", "-paper.lcm", "-skein.lcm", ".svg"}) {
    EXPECT_GT(Contents(File("one" + name)).size(), 5000u) << name;
    EXPECT_TRUE(Contents(File("one" + name)) == Contents(File("two" + name))) << name;
  }
}

TEST_F(FlightExperiment, WritesARowPerUavAndControlStep) {
  const Finished flown =
      Fly({kScenarios + "paper-link-drop.json", "--duration", "2", "--csv", File("flight.csv")});
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  const std::string csv = Contents(File("flight.csv"));
  EXPECT_EQ(
      csv.rfind(
          "t_s,vehicle_id,east_m,north_m,up_m,speed_m_s,course_rad,climb_rad,slot_forward_m,slot_left_m,"
          "slot_up_m,link,level",
          0),
      0u);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 41 * 3);
  EXPECT_NE(csv.find("\n2.00,3,"), std::string::npos);
}

struct Recorded {
  std::map<std::string, int> count;  ///< of messages, by channel
  std::vector<std::int64_t> state_stamps;
  std::vector<std::string> states;  ///< as they went over the bus
};

Recorded ReadLog(const std::string& file) {
  Recorded recorded;
  lcm::LogFile log(file, "r");
  EXPECT_TRUE(log.good());
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    ++recorded.count[event->channel];
    if (event->channel != "FLEET_STATE") continue;
    recorded.state_stamps.push_back(event->timestamp);
    recorded.states.emplace_back(static_cast<const char*>(event->data),
                                 static_cast<std::size_t>(event->datalen));
  }
  return recorded;
}

TEST_F(FlightExperiment, WritesALogWithSimulatedTimeThatLcmLogplayerPlays) {
  const Finished flown =
      Fly({kScenarios + "paper-link-drop.json", "--duration", "10", "--log", File("flight.lcm")});
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  const Recorded recorded = ReadLog(File("flight.lcm"));
  ASSERT_EQ(recorded.states.size(), 201u);
  for (std::size_t i = 0; i < recorded.states.size(); ++i) {
    ASSERT_EQ(recorded.state_stamps[i], 1'577'836'800'000'000 + static_cast<std::int64_t>(i) * 50'000);
    fleet_state_t state;
    ASSERT_GT(state.decode(recorded.states[i].data(), 0, static_cast<int>(recorded.states[i].size())), 0);
    ASSERT_EQ(state.utime, recorded.state_stamps[i]);
    ASSERT_EQ(state.num_vehicles, 3);
  }
  for (const char* channel : {"FLEET_ROSTER", "CMD_FLEET", "FORMATION", "FORMATION_STATUS", "PROXIMITY",
                              "LINK_STATUS", "HEARTBEAT"}) {
    EXPECT_GT(recorded.count.count(channel), 0u) << channel;
  }

  const Finished played = RunToEnd(
      {"lcm-logplayer", "-s", "100", "-l", "file://" + File("played.lcm") + "?mode=w", File("flight.lcm")});
  ASSERT_EQ(played.exit_code, 0) << played.output;
  const Recorded replayed = ReadLog(File("played.lcm"));
  EXPECT_EQ(replayed.count, recorded.count);
  EXPECT_TRUE(replayed.states == recorded.states);
}

TEST_F(FlightExperiment, DrawsAllRunsInOneFigure) {
  const Finished flown = Fly(
      {kScenarios + "turn.json", "--duration", "5", "--control", "paper,skein", "--plot", File("turn.svg")});
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  const std::string svg = Contents(File("turn.svg"));
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_NE(svg.find(">paper</text>"), std::string::npos);
  EXPECT_NE(svg.find(">skein</text>"), std::string::npos);
  EXPECT_NE(svg.find(">Forward error</text>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(flown.output.find("control paper"), std::string::npos);
  EXPECT_NE(flown.output.find("control skein"), std::string::npos);
}

struct BadArguments {
  std::vector<std::string> arguments;
  std::string said;
};

void PrintTo(const BadArguments& bad, std::ostream* out) {
  for (const std::string& argument : bad.arguments) *out << argument << ' ';
}

class FlightExperimentRefuses : public ::testing::TestWithParam<BadArguments> {};

TEST_P(FlightExperimentRefuses, WithExitCode2) {
  std::vector<std::string> command{kProgram};
  command.insert(command.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Finished refused = RunToEnd(command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find(GetParam().said), std::string::npos) << refused.output;
}

const std::string kAssembly = kScenarios + "paper-assembly.json";

INSTANTIATE_TEST_SUITE_P(
    BadArguments, FlightExperimentRefuses,
    ::testing::Values(BadArguments{{}, "name a scenario"},
                      BadArguments{{"no-such-scenario"}, "no-such-scenario: there is no such file"},
                      BadArguments{{"/"}, "/: is a folder"},
                      BadArguments{{kAssembly, "--control", "magic"}, "magic"},
                      BadArguments{{kAssembly, "--duration", "0"}, "--duration"},
                      BadArguments{{kAssembly, "--duration", "soon"}, "soon"},
                      BadArguments{{kAssembly, "--seed", "-x"}, "--seed"},
                      BadArguments{{kAssembly, "--csv", "/no/such/folder/flight.csv"},
                                   "No such file or directory"},
                      BadArguments{{kAssembly, "--log", "/no/such/folder/flight.lcm"}, "cannot be written"},
                      BadArguments{{kAssembly, "--plot", "/"}, "/: cannot be written"}));

TEST_F(FlightExperiment, SaysWhenTheDiskIsFull) {
  const Finished full = Fly({kAssembly, "--duration", "5", "--csv", "/dev/full"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_NE(full.output.find("/dev/full: could not be written wholly"), std::string::npos) << full.output;
}

TEST_F(FlightExperiment, EndsCleanlyOnASignal) {
  testing::Process flight(
      {kProgram, kScenarios + "hundred.json", "--duration", "100000", "--csv", File("flight.csv")});
  while (!std::filesystem::exists(File("flight.csv")) ||
         std::filesystem::file_size(File("flight.csv")) < 10'000) {
    ASSERT_FALSE(flight.WaitForEnd(testing::Seconds(0.05)));
  }
  flight.Signal(SIGINT);
  EXPECT_EQ(flight.WaitForEnd(testing::Seconds(30)), 1);
  EXPECT_NE(flight.output().find("interrupted"), std::string::npos);
  EXPECT_EQ(Contents(File("flight.csv")).back(), '\n');
}

}  // namespace
}  // namespace skein::experiment

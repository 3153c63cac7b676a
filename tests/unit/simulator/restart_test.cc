#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <skein/ack_t.hpp>
#include <string>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "simulator/simulator_node.h"

namespace skein::simulator {
namespace {

namespace channel = bus::channel;
namespace fs = std::filesystem;

/// A simulator that flies "one" of a folder with three files.
class RestartTest : public testing::Test {
 protected:
  RestartTest() {
    fs::create_directories(folder_);
    Write("one", 1);
    Write("two", 2);
    std::ofstream(folder_ / "broken.json") << R"({"name": 7})";
    bus::SubscribeChunks<fleet_state_t>(station_, channel::kFleetState,
                                        [this](const fleet_state_t& state, int) { state_ = state; });
    bus::SubscribeChunks<fleet_roster_t>(station_, channel::kFleetRoster,
                                         [this](const fleet_roster_t& roster, int) { roster_ = roster; });
    station_.Subscribe<ack_t>(channel::kAck, [this](const ack_t& ack) {
      ack_ = ack;
      ++acks_;
    });
    node_ = std::make_unique<FleetSimulatorNode>(
        simulator_, SimulatorOptions{config::LoadScenario(folder_ / "one.json"), 1});
    Run(10);
  }
  ~RestartTest() override { fs::remove_all(folder_); }

  void Write(const std::string& name, int vehicles) {
    std::ofstream file(folder_ / (name + ".json"));
    file << R"({"name": "Scenario )" << name
         << R"(", "origin": {"latitude_deg": 0, "longitude_deg": 0}, "vehicles": [)";
    for (int id = 1; id <= vehicles; ++id) {
      file << (id > 1 ? "," : "") << R"({"id": )" << id << R"(, "east_m": )" << 1000 * id
           << R"(, "north_m": 0, "up_m": 500, "speed_m_s": 50, "course_deg": 0})";
    }
    file << "]}";
  }

  void Run(double seconds) { executor_.RunFor(bus::ToUtime(seconds)); }

  simulation_command_t Command(std::int8_t action, const std::string& scenario = "") {
    simulation_command_t command{};
    command.utime = executor_.Now();
    command.session_id = 1;
    command.request_id = ++requests_;
    command.to_session_id = simulator_.session_id();
    command.action = action;
    command.scenario = scenario;
    return command;
  }
  ack_t Ask(const simulation_command_t& command) {
    station_.Publish(channel::kCmdSimulation, command);
    executor_.Deliver();
    return ack_;
  }
  ack_t Load(const std::string& scenario) {
    return Ask(Command(simulation_command_t::ACTION_LOAD, scenario));
  }

  fs::path folder_ = fs::temp_directory_path() / ("skein_restart_" + std::to_string(getpid()));
  std::shared_ptr<lcm::LCM> transport_ = bus::MakeTransport("memq://").lcm;
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus station_{transport_, "station", executor_};
  bus::Bus simulator_{transport_, "fleet-simulator", executor_};
  std::unique_ptr<FleetSimulatorNode> node_;
  fleet_state_t state_;
  fleet_roster_t roster_;
  ack_t ack_;
  int acks_ = 0;
  std::int64_t requests_ = 0;
};

TEST_F(RestartTest, BeginsANewFlightAtTheNextTickWithALaterSession) {
  const fleet_state_t before = state_;
  EXPECT_NEAR(before.vehicles[0].north_m, 500, 1e-6);
  EXPECT_TRUE(Ask(Command(simulation_command_t::ACTION_RESTART)).accepted);
  Run(0.05);
  EXPECT_EQ(state_.tick, 0);
  EXPECT_EQ(state_.utime, before.utime + FleetSimulatorNode::kPeriod);
  EXPECT_GT(state_.session_id, before.session_id);
  EXPECT_NEAR(state_.vehicles[0].north_m, 0, 1e-6);
  EXPECT_EQ(roster_.start_utime, state_.utime) << "the roster comes with the first tick";
  Run(10);
  EXPECT_EQ(state_.tick, 200);
  EXPECT_NEAR(state_.vehicles[0].north_m, 500, 1e-6);
}

TEST_F(RestartTest, LoadsAnotherScenarioByItsName) {
  EXPECT_TRUE(Load("two").accepted);
  Run(0.05);
  EXPECT_EQ(roster_.scenario, "Scenario two");
  EXPECT_EQ(roster_.vehicles.size(), 2u);
  EXPECT_EQ(state_.vehicles.size(), 2u);
  EXPECT_TRUE(Load("one").accepted);
  Run(0.05);
  EXPECT_EQ(state_.vehicles.size(), 1u);
}

TEST_F(RestartTest, ReadsTheFileAgain) {
  Write("one", 3);
  EXPECT_TRUE(Ask(Command(simulation_command_t::ACTION_RESTART)).accepted);
  Run(0.05);
  EXPECT_EQ(state_.vehicles.size(), 3u);
}

TEST_F(RestartTest, RefusesWhatItCannotFlyAndFliesOn) {
  EXPECT_NE(Load("three").reason.find("there is no scenario three; there are: broken, "), std::string::npos)
      << ack_.reason;
  for (const std::string path : {"", ".", "../one", "/etc/passwd", "one/../two", "a b", "one\n", ".one"}) {
    const ack_t refused = Load(path);
    EXPECT_FALSE(refused.accepted) << path;
    EXPECT_NE(refused.reason.find("without a folder"), std::string::npos) << path << ": " << refused.reason;
  }
  EXPECT_NE(Load("broken").reason.find("broken.json: /"), std::string::npos) << ack_.reason;
  Run(0.05);
  EXPECT_EQ(state_.tick, 201);
  EXPECT_EQ(roster_.scenario, "Scenario one");
}

TEST_F(RestartTest, AnswersARepeatedRequestWithoutStartingAgain) {
  const auto command = Command(simulation_command_t::ACTION_RESTART);
  Ask(command);
  Run(1);
  EXPECT_TRUE(Ask(command).accepted);
  EXPECT_EQ(acks_, 2);
  Run(0.05);
  EXPECT_EQ(state_.tick, 20);
}

TEST_F(RestartTest, TakesNoCommandThatAnswersTheFlightBefore) {
  fleet_command_t command{};
  command.utime = executor_.Now();
  command.session_id = 1;
  command.request_id = 1;
  command.to_session_id = state_.session_id;
  command.state_tick = state_.tick;
  command.chunk_count = 1;
  vehicle_command_t one{};
  one.id = 1;
  one.sequence = 1;
  one.speed_input_m_s = 80;
  command.commands = {one};
  command.num_commands = 1;
  Ask(Command(simulation_command_t::ACTION_RESTART));
  Run(0.05);
  station_.Publish(channel::kCmdFleet, command);
  Run(5);
  EXPECT_EQ(state_.vehicles[0].command_sequence, 0);
  command.to_session_id = state_.session_id;
  command.state_tick = state_.tick;
  station_.Publish(channel::kCmdFleet, command);
  Run(0.2);
  EXPECT_EQ(state_.vehicles[0].command_sequence, 1);
}

}  // namespace
}  // namespace skein::simulator

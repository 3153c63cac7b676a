#include "bridge/command_gateway.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <skein/link_command_t.hpp>
#include <vector>

#include "bus/channels.h"
#include "bus/command_inbox.h"
#include "bus/simulated_executor.h"

namespace skein::bridge {
namespace {

using nlohmann::json;
using Outcome = CommandResult::Outcome;

const json kCut = {{"vehicle_id", 3}, {"mode", "silent"}};

class CommandGatewayTest : public testing::Test {
 protected:
  CommandGateway::Done Keep() {
    return [this](const CommandResult& result) { results_.push_back(result); };
  }
  /// Hears commands without answering.
  void Listen() {
    simulator_.Subscribe<link_command_t>(
        bus::channel::kCmdLink, [this](const link_command_t& command) { heard_.push_back(command); });
  }

  std::shared_ptr<lcm::LCM> transport_ = std::make_shared<lcm::LCM>("memq://");
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus bus_{transport_, "web-bridge", executor_};
  bus::Bus simulator_{transport_, "fleet-simulator", executor_};
  CommandGateway gateway_{bus_};
  std::vector<CommandResult> results_;
  std::vector<link_command_t> heard_;
};

TEST_F(CommandGatewayTest, TellsThatACommandWasAccepted) {
  bus::CommandInbox inbox(simulator_);
  inbox.Obey<link_command_t>(bus::channel::kCmdLink, [this](const link_command_t& command) {
    heard_.push_back(command);
    return bus::Answer::Accepted();
  });
  gateway_.Send("CMD_LINK", kCut, Keep());
  executor_.RunFor(5 * bus::kSecond);
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_TRUE(results_[0].accepted());
  ASSERT_EQ(heard_.size(), 1u);
  EXPECT_EQ(heard_[0].vehicle_id, 3);
  EXPECT_EQ(heard_[0].session_id, bus_.session_id());
}

TEST_F(CommandGatewayTest, TellsWhyACommandWasRefused) {
  bus::CommandInbox inbox(simulator_);
  inbox.Obey<link_command_t>(bus::channel::kCmdLink,
                             [](const link_command_t&) { return bus::Answer::Refused("there is no UAV 3"); });
  gateway_.Send("CMD_LINK", kCut, Keep());
  executor_.Deliver();
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].outcome, Outcome::kRefused);
  EXPECT_EQ(results_[0].reason, "there is no UAV 3");
}

TEST_F(CommandGatewayTest, SendsAgainAfterOneSecondAndGivesUpAfterTwo) {
  Listen();
  gateway_.Send("CMD_LINK", kCut, Keep());
  executor_.RunFor(bus::kSecond - 1);
  EXPECT_EQ(heard_.size(), 1u);
  executor_.RunFor(1);
  ASSERT_EQ(heard_.size(), 2u);
  EXPECT_EQ(heard_[0].request_id, heard_[1].request_id);
  EXPECT_EQ(heard_[1].utime - heard_[0].utime, bus::kSecond);
  executor_.RunFor(bus::kSecond - 1);
  EXPECT_TRUE(results_.empty());
  executor_.RunFor(1);
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].outcome, Outcome::kNoAnswer);
  EXPECT_EQ(results_[0].reason, "nobody answered CMD_LINK within 2 s: is fleet-simulator running?");
  executor_.RunFor(5 * bus::kSecond);
  EXPECT_EQ(heard_.size(), 2u);
  EXPECT_EQ(results_.size(), 1u);
}

TEST_F(CommandGatewayTest, NamesTheControllerWhenItIsTheOneThatIsMissing) {
  gateway_.Send("CMD_PATH", {{"formation_id", 1}, {"waypoints", json::array()}}, Keep());
  executor_.RunFor(2 * bus::kSecond);
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_NE(results_[0].reason.find("is formation-controller running?"), std::string::npos);
}

TEST_F(CommandGatewayTest, TakesOnlyTheAnswerToItsOwnCommand) {
  Listen();
  gateway_.Send("CMD_LINK", kCut, Keep());
  executor_.Deliver();
  ASSERT_EQ(heard_.size(), 1u);
  ack_t ack{};
  ack.node = "fleet-simulator";
  ack.accepted = true;
  ack.session_id = heard_[0].to_session_id;
  ack.command_channel = "CMD_LINK";
  ack.command_session_id = heard_[0].session_id + 1;
  ack.command_request_id = heard_[0].request_id;
  simulator_.Publish(bus::channel::kAck, ack);
  ack.command_session_id = heard_[0].session_id;
  ack.command_request_id = heard_[0].request_id + 1;
  simulator_.Publish(bus::channel::kAck, ack);
  ack.command_request_id = heard_[0].request_id;
  ack.command_channel = "CMD_PAYLOAD";
  simulator_.Publish(bus::channel::kAck, ack);
  executor_.Deliver();
  EXPECT_TRUE(results_.empty());
  ack.command_channel = "CMD_LINK";
  simulator_.Publish(bus::channel::kAck, ack);
  simulator_.Publish(bus::channel::kAck, ack);
  executor_.Deliver();
  EXPECT_EQ(results_.size(), 1u);
}

TEST_F(CommandGatewayTest, RefusesWhatIsMalformedWithoutSendingIt) {
  Listen();
  gateway_.Send("CMD_LINK", {{"vehicle_id", 3}}, Keep());
  gateway_.Send("CMD_FLEET", json::object(), Keep());
  gateway_.Send("CMD_FORMATION",
                {{"action", "hold"}, {"formation", {{"formation_id", 1}, {"name", "a\u0001b"}}}}, Keep());
  ASSERT_EQ(results_.size(), 3u);
  for (const CommandResult& result : results_)
    EXPECT_EQ(result.outcome, Outcome::kMalformed) << result.reason;
  EXPECT_NE(results_[1].reason.find("channel: must be CMD_LINK"), std::string::npos);
  EXPECT_NE(results_[2].reason.find("control character"), std::string::npos);
  executor_.Deliver();
  EXPECT_TRUE(heard_.empty());
}

TEST_F(CommandGatewayTest, LetsOnlySoManyCommandsWait) {
  for (std::size_t i = 0; i < CommandGateway::kMaxWaiting; ++i) gateway_.Send("CMD_LINK", kCut, Keep());
  EXPECT_TRUE(results_.empty());
  gateway_.Send("CMD_LINK", kCut, Keep());
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].outcome, Outcome::kBusy);
  executor_.RunFor(2 * bus::kSecond);
  EXPECT_EQ(results_.size(), CommandGateway::kMaxWaiting + 1);
}

}  // namespace
}  // namespace skein::bridge

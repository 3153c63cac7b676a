#include <gtest/gtest.h>

#include <vector>

#include "unit/simulator/simulator_under_test.h"

namespace skein::simulator {
namespace {

using bus::kSecond;

TEST_F(SimulatorTest, TimelineCutsAndRestoresALinkOnTime) {
  config::Scenario scenario = ScenarioOf(3);
  scenario.timeline = {{2.0, config::CutLink{.vehicle_id = 3, .for_s = {}}},
                       {3.0, config::RestoreLink{.vehicle_id = 3}}};
  Start(scenario);
  RunUntil(10);
  const auto missing = MissingTimes(3);
  ASSERT_EQ(missing.size(), 20u);
  EXPECT_DOUBLE_EQ(missing.front(), 2);
  EXPECT_DOUBLE_EQ(missing.back(), 2.95);
  EXPECT_TRUE(MissingTimes(1).empty());
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[0].code, "link_cut");
  EXPECT_EQ(events_[0].severity, event_t::INFO);
  EXPECT_EQ(events_[0].vehicle_id, 3);
  EXPECT_EQ(events_[0].text, "data link of UAV3 is cut");
  EXPECT_EQ(events_[1].code, "link_cut_ended");
  EXPECT_EQ(events_[1].text, "data link of UAV3 is up");
}

TEST_F(SimulatorTest, TimelineRepeats) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::CutLink{.vehicle_id = 1, .for_s = 0.5}}};
  scenario.timeline_repeat_s = 4;
  Start(scenario);
  RunUntil(10);
  std::vector<double> expected;
  for (const double begin : {1.0, 5.0, 9.0}) {
    for (int i = 0; i < 10; ++i) expected.push_back(begin + i * 0.05);
  }
  const auto missing = MissingTimes(1);
  ASSERT_EQ(missing.size(), expected.size());
  for (std::size_t i = 0; i < missing.size(); ++i) EXPECT_NEAR(missing[i], expected[i], 1e-9);
}

TEST_F(SimulatorTest, TimelineSetsQualitiesAndLeavesTheOtherDirectionAlone) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::SetLink{.vehicle_id = 1,
                                             .uplink = {},
                                             .downlink = config::LinkQuality{.delay_s = 0.2, .loss = 0.1}}}};
  Start(scenario);
  RunUntil(2);
  EXPECT_EQ(node_->fleet()[0].downlink().quality.delay_s, 0.2);
  EXPECT_EQ(node_->fleet()[0].uplink().quality.delay_s, 0);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].code, "link_set");
  EXPECT_EQ(events_[0].text,
            "data link of UAV1: uplink up, downlink up with 0.2 s delay, 0 s jitter, 10% loss");
}

TEST_F(SimulatorTest, FreezesALinkThatRepeatsItsLastState) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.timeline = {{1.0, config::CutLink{.vehicle_id = 1, .frozen = true, .for_s = {}}}};
  Start(scenario);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
  EXPECT_EQ(states_.back().vehicles[0].utime, SimulatedExecutor::kStart + bus::ToUtime(0.95));
}

TEST_F(SimulatorTest, CutsALinkForAWhileOnRequest) {
  Start(ScenarioOf(3));
  RunUntil(1);
  link_command_t command = Cut(2);
  command.duration_s = 3;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(10);
  const auto missing = MissingTimes(2);
  ASSERT_EQ(missing.size(), 59u);  // the state of t = 1 had been sent already
  EXPECT_DOUBLE_EQ(missing.front(), 1.05);
  EXPECT_DOUBLE_EQ(missing.back(), 3.95);
}

TEST_F(SimulatorTest, CutsALinkAtAGivenTime) {
  Start(ScenarioOf(3));
  RunUntil(1);
  link_command_t command = Cut(2);
  command.start_utime = SimulatedExecutor::kStart + 5 * kSecond;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(10);
  EXPECT_DOUBLE_EQ(MissingTimes(2).front(), 5);
}

TEST_F(SimulatorTest, ACutThatIsUndoneByHandDoesNotEndAgainLater) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t cut = Cut(1);
  cut.duration_s = 3;
  Request(channel::kCmdLink, cut);
  RunUntil(2);
  link_command_t restore = Cut(1);
  restore.mode = link_command_t::MODE_UP;
  Request(channel::kCmdLink, restore);
  RunUntil(3);
  Request(channel::kCmdLink, Cut(1));  // for good
  RunUntil(10);
  EXPECT_EQ(node_->fleet()[0].downlink().mode, LinkMode::kSilent);
  EXPECT_EQ(events_.size(), 3u);
}

TEST_F(SimulatorTest, RestoringBringsBackTheQualityThatTheScenarioBeganWith) {
  config::Scenario scenario = ScenarioOf(1);
  scenario.vehicles[0].uplink.delay_s = 0.3;
  scenario.vehicles[0].downlink.loss = 0.2;
  scenario.timeline = {{5.0, config::RestoreLink{.vehicle_id = 1}}};
  Start(scenario);
  RunUntil(1);
  const auto expect_as_at_start = [this] {
    EXPECT_EQ(node_->fleet()[0].uplink().mode, LinkMode::kUp);
    EXPECT_EQ(node_->fleet()[0].uplink().quality.delay_s, 0.3);
    EXPECT_EQ(node_->fleet()[0].downlink().quality.loss, 0.2);
  };
  link_command_t command = Cut(1);
  command.mode = link_command_t::MODE_UP;  // with no delay and no loss
  Request(channel::kCmdLink, command);
  Request(channel::kCmdLink, Cut(1));
  RunUntil(2);
  EXPECT_EQ(node_->fleet()[0].downlink().quality.loss, 0);
  command = Cut(1);
  command.mode = link_command_t::MODE_RESTORED;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  RunUntil(3);
  expect_as_at_start();
  command = Cut(1);
  command.mode = link_command_t::MODE_UP;
  Request(channel::kCmdLink, command);
  RunUntil(6);
  expect_as_at_start();
}

TEST_F(SimulatorTest, CutsOneDirectionAlone) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t command = Cut(1);
  command.downlink = false;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  SendCommand(1, 1, 60);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
  EXPECT_EQ(states_.back().vehicles[0].command_sequence, 0);
}

TEST_F(SimulatorTest, RestoringALinkThatIsUpIsNoEvent) {
  Start(ScenarioOf(1));
  RunUntil(1);
  link_command_t command = Cut(1);
  command.mode = link_command_t::MODE_UP;
  EXPECT_TRUE(Request(channel::kCmdLink, command).accepted);
  EXPECT_TRUE(events_.empty());
}

TEST_F(SimulatorTest, RefusesLinkCommandsThatMakeNoSense) {
  Start(ScenarioOf(1));
  RunUntil(1);
  EXPECT_EQ(Request(channel::kCmdLink, Cut(9)).reason, "there is no UAV 9");
  link_command_t none = Cut(1);
  none.uplink = none.downlink = false;
  EXPECT_EQ(Request(channel::kCmdLink, none).reason, "neither uplink nor downlink is meant");
  link_command_t loss = Cut(1);
  loss.loss = 1.5;
  EXPECT_FALSE(Request(channel::kCmdLink, loss).accepted);
  link_command_t delay = Cut(1);
  delay.delay_s = 1e6;
  EXPECT_FALSE(Request(channel::kCmdLink, delay).accepted);
  link_command_t duration = Cut(1);
  duration.duration_s = -1;
  EXPECT_FALSE(Request(channel::kCmdLink, duration).accepted);
  RunUntil(2);
  EXPECT_TRUE(MissingTimes(1).empty());
}

TEST_F(SimulatorTest, SwitchesPayloadsOverTheUplink) {
  Start(ScenarioOf(3));
  RunUntil(1);
  const ack_t ack = Request(channel::kCmdPayload, Payload(true, {1, 3}));
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.reason, "");
  RunUntil(2);
  EXPECT_TRUE(states_.back().vehicles[0].payload_on);
  EXPECT_FALSE(states_.back().vehicles[1].payload_on);
  EXPECT_TRUE(states_.back().vehicles[2].payload_on);
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_EQ(events_[0].code, "payload_on");
  EXPECT_EQ(events_[0].text, "payload of UAV1 is on");
  Request(channel::kCmdPayload, Payload(false, {1}));
  RunUntil(3);
  EXPECT_FALSE(states_.back().vehicles[0].payload_on);
  EXPECT_EQ(events_.back().code, "payload_off");
}

TEST_F(SimulatorTest, SaysWhenAPayloadCannotBeReached) {
  Start(ScenarioOf(2));
  RunUntil(1);
  Request(channel::kCmdLink, Cut(2));
  const ack_t ack = Request(channel::kCmdPayload, Payload(true, {1, 2}));
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.reason, "the uplink is cut: UAV2");
  RunUntil(2);
  EXPECT_TRUE(node_->fleet()[0].payload_on());
  EXPECT_FALSE(node_->fleet()[1].payload_on());
}

TEST_F(SimulatorTest, RefusesPayloadCommandsAsAWhole) {
  config::Scenario scenario = ScenarioOf(2);
  scenario.vehicles[1].has_payload = false;
  Start(scenario);
  RunUntil(1);
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {})).reason, "no UAV is named");
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {1, 9})).reason, "there is no UAV 9");
  EXPECT_EQ(Request(channel::kCmdPayload, Payload(true, {1, 2})).reason, "UAV2 has no payload");
  RunUntil(2);
  EXPECT_FALSE(node_->fleet()[0].payload_on());
}

}  // namespace
}  // namespace skein::simulator

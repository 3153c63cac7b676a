#include "bus/bus.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "bus/channels.h"
#include "bus/command_inbox.h"
#include "bus/command_outbox.h"
#include "bus/events.h"
#include "bus/heartbeat.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::bus {
namespace {

class BusTest : public testing::Test {
 protected:
  std::shared_ptr<lcm::LCM> transport_ = MakeTransport("memq://").lcm;
  SimulatedExecutor executor_{transport_};
  Bus station_{transport_, "station", executor_};
  Bus node_{transport_, "node", executor_};

  link_command_t LinkCommand(std::int64_t request_id) const {
    link_command_t command;
    command.utime = executor_.Now();
    command.session_id = station_.session_id();
    command.request_id = request_id;
    command.to_session_id = node_.session_id();
    command.vehicle_id = 3;
    return command;
  }
};

TEST_F(BusTest, HandsAMessageToEverySubscriber) {
  std::vector<std::string> heard;
  station_.Subscribe<event_t>(channel::kEvent,
                              [&](const event_t& event) { heard.push_back("a " + event.text); });
  node_.Subscribe<event_t>(channel::kEvent,
                           [&](const event_t& event) { heard.push_back("b " + event.text); });
  Events events(node_);
  events.Tell(event_t::CAUTION, "link_lost", "UAV3 is lost", {.vehicle_id = 3});
  executor_.Deliver();
  EXPECT_EQ(heard, (std::vector<std::string>{"a UAV3 is lost", "b UAV3 is lost"}));
  EXPECT_EQ(node_.statistics().messages_out, 1);
  EXPECT_EQ(station_.statistics().messages_in, 1);
}

TEST_F(BusTest, CountsAndDropsWhatDoesNotDecodeOrIsOutOfRange) {
  int handled = 0;
  station_.Subscribe<event_t>(channel::kEvent, [&](const event_t&) { ++handled; });
  event_t event;
  event.event_node = "node";
  event.code = "test";
  event.severity = 9;
  node_.Publish(channel::kEvent, event);         // no such severity
  node_.Publish(channel::kEvent, ack_t{});       // another type
  transport_->publish(channel::kEvent, "x", 1);  // garbage
  event.severity = event_t::INFO;
  node_.Publish(channel::kEvent, event);
  executor_.Deliver();
  EXPECT_EQ(handled, 1);
  EXPECT_EQ(station_.statistics().undecodable, 3);
}

TEST_F(BusTest, OutlivesAHandlerThatThrows) {
  int handled = 0;
  station_.Subscribe<event_t>(channel::kEvent, [&](const event_t&) {
    if (++handled == 1) throw std::runtime_error("on purpose");
  });
  Events events(node_);
  events.Tell(event_t::INFO, "one", "1");
  events.Tell(event_t::INFO, "two", "2");
  executor_.Deliver();
  EXPECT_EQ(handled, 2);
  EXPECT_EQ(station_.statistics().handler_exceptions, 1);
}

TEST_F(BusTest, EndsItsSubscriptionsWhenItEnds) {
  int handled = 0;
  {
    Bus passing(transport_, "passing", executor_);
    passing.Subscribe<event_t>(channel::kEvent, [&](const event_t&) { ++handled; });
  }
  Events(node_).Tell(event_t::INFO, "one", "1");
  executor_.Deliver();
  EXPECT_EQ(handled, 0);
}

TEST_F(BusTest, NumbersItsEvents) {
  std::vector<std::int64_t> numbers;
  station_.Subscribe<event_t>(channel::kEvent,
                              [&](const event_t& event) { numbers.push_back(event.event_sequence); });
  Events events(node_);
  for (int i = 0; i < 3; ++i) events.Tell(event_t::INFO, "code", "text");
  executor_.Deliver();
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{1, 2, 3}));
}

TEST_F(BusTest, BeatsOnceASecondWithItsCounts) {
  std::vector<heartbeat_t> beats;
  station_.Subscribe<heartbeat_t>(channel::kHeartbeat,
                                  [&](const heartbeat_t& beat) { beats.push_back(beat); });
  StartHeartbeat(node_, 212992);
  node_.CountGaps(5);
  executor_.RunFor(3 * kSecond);
  ASSERT_EQ(beats.size(), 3U);
  EXPECT_EQ(beats[0].utime, SimulatedExecutor::kStart + kSecond);
  EXPECT_EQ(beats[0].heartbeat_node, "node");
  EXPECT_EQ(beats[0].gaps, 5);
  EXPECT_EQ(beats[0].messages_out, 0);
  EXPECT_EQ(beats[2].messages_out, 2);
  EXPECT_EQ(beats[2].receive_buffer_bytes, 212992);
}

class CommandInboxTest : public BusTest {
 protected:
  void SetUp() override {
    inbox_.Obey<link_command_t>(channel::kCmdLink, [this](const link_command_t& command) {
      done_.push_back(command.request_id);
      return command.vehicle_id == 3 ? Answer::Accepted() : Answer::Refused("there is no such UAV");
    });
    station_.Subscribe<ack_t>(channel::kAck, [this](const ack_t& ack) { acks_.push_back(ack); });
  }

  void Send(const link_command_t& command) {
    station_.Publish(channel::kCmdLink, command);
    executor_.Deliver();
  }

  CommandInbox inbox_{node_};
  std::vector<std::int64_t> done_;
  std::vector<ack_t> acks_;
};

TEST_F(CommandInboxTest, AnswersAndTellsWhoDid) {
  Send(LinkCommand(1));
  ASSERT_EQ(acks_.size(), 1U);
  EXPECT_TRUE(acks_[0].accepted);
  EXPECT_EQ(acks_[0].node, "node");
  EXPECT_EQ(acks_[0].command_channel, channel::kCmdLink);
  EXPECT_EQ(acks_[0].command_session_id, station_.session_id());
  EXPECT_EQ(acks_[0].command_request_id, 1);
}

TEST_F(CommandInboxTest, SaysWhyNot) {
  auto command = LinkCommand(1);
  command.vehicle_id = 9;
  Send(command);
  ASSERT_EQ(acks_.size(), 1U);
  EXPECT_FALSE(acks_[0].accepted);
  EXPECT_EQ(acks_[0].reason, "there is no such UAV");
}

TEST_F(CommandInboxTest, AnswersARepeatedRequestAgainWithoutDoingItAgain) {
  Send(LinkCommand(1));
  Send(LinkCommand(2));
  Send(LinkCommand(1));
  EXPECT_EQ(done_, (std::vector<std::int64_t>{1, 2}));
  ASSERT_EQ(acks_.size(), 3U);
  EXPECT_TRUE(acks_[2].accepted);
  EXPECT_EQ(acks_[2].command_request_id, 1);
}

TEST_F(CommandInboxTest, RefusesAnOlderRequestThatItNeverSaw) {
  Send(LinkCommand(5));
  Send(LinkCommand(4));
  EXPECT_EQ(done_, (std::vector<std::int64_t>{5}));
  ASSERT_EQ(acks_.size(), 2U);
  EXPECT_FALSE(acks_[1].accepted);
  EXPECT_EQ(acks_[1].reason, "request 4 is not newer than request 5, which was obeyed");
}

TEST_F(CommandInboxTest, KeepsSendersApart) {
  Send(LinkCommand(5));
  auto command = LinkCommand(1);
  command.session_id = 7;
  Send(command);
  EXPECT_EQ(done_, (std::vector<std::int64_t>{5, 1}));
}

TEST_F(CommandInboxTest, RefusesWhatWasMeantForAnotherRunAndTellsItsAddress) {
  auto command = LinkCommand(1);
  for (const std::int64_t other : {std::int64_t{0}, node_.session_id() - 1, node_.session_id() + 1}) {
    command.to_session_id = other;
    Send(command);
    EXPECT_FALSE(acks_.back().accepted);
    EXPECT_EQ(acks_.back().reason, "meant for another run of node: send it again");
    EXPECT_EQ(acks_.back().session_id, node_.session_id());
  }
  EXPECT_TRUE(done_.empty());
  Send(LinkCommand(1));
  EXPECT_TRUE(acks_.back().accepted);
  EXPECT_EQ(done_, (std::vector<std::int64_t>{1}));
}

TEST_F(CommandInboxTest, DoesNotDoAgainWhatManySendersAgoItObeyed) {
  const auto first = LinkCommand(1);
  Send(first);
  auto command = LinkCommand(1);
  for (int i = 0; i < 1000; ++i) {
    ++command.session_id;
    Send(command);
  }
  Send(first);
  EXPECT_EQ(done_.size(), 1001U);
  EXPECT_FALSE(acks_.back().accepted);
}

class CommandOutboxTest : public BusTest {
 protected:
  void SetUp() override {
    station_.Subscribe<link_command_t>(channel::kCmdLink,
                                       [this](const link_command_t& command) { heard_.push_back(command); });
  }

  /// A node, or the next run of it.
  void StartNode() {
    inbox_.reset();
    other_.reset();
    executor_.RunFor(kSecond);
    other_ = std::make_unique<Bus>(transport_, "node", executor_);
    inbox_ = std::make_unique<CommandInbox>(*other_);
    inbox_->Obey<link_command_t>(channel::kCmdLink, [this](const link_command_t&) {
      ++done_;
      return Answer::Accepted();
    });
  }

  void Send(CommandOutbox& outbox) {
    answer_.reset();
    outbox.Send(channel::kCmdLink, LinkCommand(0), [this](const Answer& answer) { answer_ = answer; });
    executor_.Deliver();
  }

  std::unique_ptr<Bus> other_;
  std::unique_ptr<CommandInbox> inbox_;
  std::vector<link_command_t> heard_;
  std::optional<Answer> answer_;
  int done_ = 0;
};

TEST_F(CommandOutboxTest, FindsTheAddressOfANodeAndOfItsNextRunAtOnce) {
  CommandOutbox outbox(station_);
  for (int run = 1; run <= 2; ++run) {
    StartNode();
    Send(outbox);
    ASSERT_TRUE(answer_) << "run " << run;
    EXPECT_TRUE(answer_->accepted) << answer_->reason;
    EXPECT_EQ(done_, 2 * run - 1);
    EXPECT_EQ(heard_.back().to_session_id, other_->session_id());
    heard_.clear();
    Send(outbox);
    EXPECT_EQ(heard_.size(), 1U) << "the address is known now";
    EXPECT_EQ(done_, 2 * run);
  }
}

TEST_F(CommandOutboxTest, SendsToAnotherAddressOnlyOnce) {
  CommandOutbox outbox(station_);
  Send(outbox);
  ASSERT_EQ(heard_.size(), 1U);
  ack_t ack;
  ack.node = "node";
  ack.command_channel = channel::kCmdLink;
  ack.command_session_id = station_.session_id();
  ack.command_request_id = heard_[0].request_id;
  for (ack.session_id = 5; ack.session_id < 9; ++ack.session_id) {
    node_.Publish(channel::kAck, ack);
    executor_.Deliver();
  }
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].to_session_id, 5);
  EXPECT_FALSE(answer_);
  EXPECT_TRUE(outbox.Forget(heard_[0].request_id));
}

}  // namespace
}  // namespace skein::bus

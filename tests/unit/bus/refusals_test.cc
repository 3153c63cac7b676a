#include "bus/refusals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <skein/event_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/link_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/memory_transport.h"
#include "bus/simulated_executor.h"

namespace skein::bus {
namespace {

class RefusalsTest : public ::testing::Test {
 protected:
  RefusalsTest() {
    stranger_.Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { events_.push_back(event); });
    SubscribeChunks<fleet_state_t>(node_, channel::kFleetState, [this](const fleet_state_t& state, int) {
      fleets_.push_back(state.vehicles.size());
    });
    node_.Subscribe<link_status_t>(channel::kLinkStatus, [](const link_status_t&) {});
    TellRefusals(node_);
  }

  static vehicle_state_t Uav(int id, double east_m = 0) {
    vehicle_state_t uav{};
    uav.id = id;
    uav.east_m = east_m;
    return uav;
  }
  void Send(const std::vector<vehicle_state_t>& vehicles) {
    fleet_state_t state{};
    state.utime = executor_.Now();
    state.session_id = 1;
    state.tick = ++tick_;
    state.vehicles = vehicles;
    PublishChunks(stranger_, channel::kFleetState, state);
    executor_.RunFor(kSecond);
  }

  std::shared_ptr<lcm::LCM> transport_ = MemoryTransport();
  SimulatedExecutor executor_{transport_};
  Bus node_{transport_, "node", executor_};
  Bus stranger_{transport_, "stranger", executor_};
  std::int64_t tick_ = 0;
  std::vector<event_t> events_;
  std::vector<std::size_t> fleets_;  ///< sizes of those that came through
};

TEST_F(RefusalsTest, AreToldOnceForAChannelAndAllCounted) {
  Send({Uav(1), Uav(2)});
  EXPECT_TRUE(events_.empty());
  for (int i = 0; i < 3; ++i) Send({Uav(1, std::nan(""))});
  ASSERT_EQ(events_.size(), 1U);
  EXPECT_EQ(events_[0].code, "message_refused");
  EXPECT_NE(events_[0].text.find("FLEET_STATE"), std::string::npos) << events_[0].text;
  EXPECT_EQ(node_.statistics().undecodable, 3);
  EXPECT_EQ(fleets_, std::vector<std::size_t>{2});

  link_status_t links{};
  links.chunk_count = 0;
  stranger_.Publish(channel::kLinkStatus, links);
  executor_.RunFor(2 * kSecond);
  ASSERT_EQ(events_.size(), 2U);
  EXPECT_EQ(events_[1].event_sequence, events_[0].event_sequence + 1);
}

TEST_F(RefusalsTest, MeetAUavThatIsThereTwiceInAnyOrder) {
  Send({Uav(1), Uav(2), Uav(1)});
  Send({Uav(2), Uav(2)});
  EXPECT_EQ(node_.statistics().undecodable, 2);
  Send({Uav(3), Uav(1), Uav(2)});
  EXPECT_EQ(fleets_, std::vector<std::size_t>{3});
}

TEST_F(RefusalsTest, AreToldOnceForEachReason) {
  for (int i = 0; i < 3; ++i) {
    Send({Uav(1, std::nan(""))});
    Refuse(node_, channel::kFleetState, "it is of another world");
    CountFlagged(node_);
  }
  executor_.RunFor(kSecond);
  ASSERT_EQ(events_.size(), 2U);
  EXPECT_EQ(events_[0].text,
            "a message on FLEET_STATE was refused: it does not decode, or holds what it must not. More of "
            "them are only counted (HEARTBEAT)");
  EXPECT_EQ(events_[1].text,
            "a message on FLEET_STATE was refused: it is of another world. More of them are only counted "
            "(HEARTBEAT)");
  EXPECT_EQ(node_.statistics().undecodable, 9);
}

TEST_F(RefusalsTest, MeetATimeThatIsADayAheadAgainAndAgain) {
  Send({Uav(1)});
  for (int i = 0; i < 3; ++i) {
    fleet_state_t wrong{};
    wrong.utime = executor_.Now() + 86'400 * kSecond;
    wrong.session_id = 1;
    wrong.tick = tick_ + 1;
    PublishChunks(stranger_, channel::kFleetState, wrong);
    Send({Uav(1)});
  }
  EXPECT_EQ(node_.statistics().undecodable, 3);
  EXPECT_EQ(fleets_.size(), 4U);
  ASSERT_EQ(events_.size(), 1U);
  EXPECT_NE(events_[0].text.find("time"), std::string::npos) << events_[0].text;
}

TEST_F(RefusalsTest, MeetAFleetOfAMillion) {
  std::vector<vehicle_state_t> million;
  for (int id = 1; id <= 1'000'000; ++id) million.push_back(Uav(id));
  Send(million);
  EXPECT_GT(node_.statistics().undecodable, 0);
  EXPECT_TRUE(fleets_.empty());
  // Who speaks the truth is heard afterwards.
  Send({Uav(1)});
  EXPECT_EQ(fleets_, std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace skein::bus

#include "bus/only_one.h"

#include <gtest/gtest.h>

#include "bus/channels.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::bus {
namespace {

/// A node that has its turn, and somebody who sends heartbeats.
class TurnTest : public testing::Test {
 protected:
  void Hear(std::int64_t session_id, Utime utime, const std::string& node = "node") {
    heartbeat_t heartbeat{};
    heartbeat.heartbeat_node = node;
    heartbeat.session_id = session_id;
    heartbeat.utime = utime;
    other_.Publish(channel::kHeartbeat, heartbeat);
    executor_.Deliver();
  }

  Transport transport_ = MakeTransport("memq://");
  SimulatedExecutor executor_{transport_.lcm};
  Bus bus_{transport_.lcm, "node", executor_};
  Bus other_{transport_.lcm, "other", executor_};
  int ends_ = 0;
  Turn turn_{bus_, 0, [this] { ++ends_; }};
  const std::int64_t later_ = bus_.session_id() + kSecond;
};

TEST_F(TurnTest, IsOverWhenALaterOneIsHeardTwice) {
  Hear(later_, later_ + kSecond);
  EXPECT_FALSE(turn_.over());
  Hear(later_, later_ + 2 * kSecond);
  EXPECT_TRUE(turn_.over());
  EXPECT_EQ(ends_, 1);
}

TEST_F(TurnTest, BeatsFourTimesASecondWhileSomebodyStandsBy) {
  int beats = 0;
  other_.Subscribe<heartbeat_t>(channel::kHeartbeat, [&](const heartbeat_t& heartbeat) {
    beats += heartbeat.heartbeat_node == "node" ? 1 : 0;
  });
  const auto beats_in = [&](Utime time) {
    beats = 0;
    executor_.RunFor(time);
    return beats;
  };
  EXPECT_EQ(beats_in(2 * kSecond), 1) << "to say that it is there; the one a second is StartHeartbeat's";
  Hear(later_, executor_.Now(), StandbyOf("node"));
  EXPECT_EQ(beats_in(2 * kSecond), 8);
  EXPECT_LT(beats_in(20 * kSecond), 20) << "the standby is gone";
  EXPECT_EQ(beats_in(2 * kSecond), 0);
}

TEST_F(TurnTest, IsNotOverForOneFalseMessageHoweverOftenItComes) {
  for (int i = 0; i < 5; ++i) Hear(later_, later_ + kSecond);
  Hear(later_ + 1, later_ + 9 * kSecond);
  Hear(bus_.session_id() - 1, later_ + 9 * kSecond);
  Hear(bus_.session_id() - 1, later_ + 10 * kSecond);
  Hear(later_, later_ + 9 * kSecond, "another-node");
  Hear(later_, later_ + 10 * kSecond, "another-node");
  EXPECT_FALSE(turn_.over());
  EXPECT_EQ(ends_, 0);
}

}  // namespace
}  // namespace skein::bus

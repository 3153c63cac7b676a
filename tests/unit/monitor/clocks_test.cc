// Hosts whose clocks differ.

#include <algorithm>
#include <skein/alarm_list_t.hpp>
#include <skein/heartbeat_t.hpp>

#include "unit/monitor/monitor_fixture.h"

namespace skein::monitor {
namespace {

class MonitorClocks : public testing::MonitorTest, public ::testing::WithParamInterface<double> {
 protected:
  MonitorClocks() {
    fleet_.Add(1, 0, 0, 1000);
    fleet_.Add(2, 0, 2000, 1000);
    executor_.Every(bus::kSecond, [this] {
      heartbeat_t heartbeat{};
      heartbeat.heartbeat_node = "fleet-simulator";
      heartbeat.utime = executor_.Now() + bus::ToUtime(fleet_.clock_ahead_s);
      station_.Publish(bus::channel::kHeartbeat, heartbeat);
    });
    station_.Subscribe<alarm_list_t>(bus::channel::kAlarms,
                                     [this](const alarm_list_t& list) { alarms_ = list.alarms; });
  }
  std::optional<alarm_t> Alarm() const {
    const auto found = std::ranges::find(alarms_, "clock:fleet-simulator", &alarm_t::condition);
    return found == alarms_.end() ? std::nullopt : std::optional(*found);
  }

  std::vector<alarm_t> alarms_;
};

TEST_P(MonitorClocks, ThatAreTwoSecondsOffAreToldAndFakeNoLostLink) {
  fleet_.clock_ahead_s = GetParam();
  Start();
  Run(30);
  ASSERT_TRUE(Alarm());
  EXPECT_EQ(Alarm()->text, std::string("the clock of fleet-simulator is 2.0 s ") +
                               (GetParam() > 0 ? "ahead of" : "behind") +
                               " the monitor's: synchronise the hosts");
  EXPECT_EQ(Alarm()->severity, event_t::CAUTION);
  for (const int id : {1, 2}) {
    EXPECT_EQ(heard_.Link(id)->downlink, link_status_t::LINK_UP);
    EXPECT_EQ(heard_.Link(id)->uplink, link_status_t::LINK_UP);
  }
  EXPECT_TRUE(heard_.Events("link_late").empty());
  EXPECT_TRUE(heard_.Events("link_lost").empty());
}

INSTANTIATE_TEST_SUITE_P(AheadAndBehind, MonitorClocks, ::testing::Values(2.0, -2.0));

TEST_F(MonitorClocks, ThatAreALittleOffAreNotToldAndOneThatIsSetRightEndsTheAlarm) {
  Start();
  fleet_.clock_ahead_s = 0.9;
  Run(10);
  EXPECT_FALSE(Alarm());
  fleet_.clock_ahead_s = 1.5;
  Run(10);
  ASSERT_TRUE(Alarm());
  fleet_.clock_ahead_s = 0.4;
  Run(3);
  EXPECT_EQ(Alarm()->state, alarm_t::ENDED);
}

TEST_F(MonitorClocks, AreNotToldWhenHeartbeatsHaveWaitedBecauseTheMonitorWasStopped) {
  Start();
  Run(5);
  for (int age_s = 10; age_s > 0; --age_s) {
    heartbeat_t heartbeat{};
    heartbeat.heartbeat_node = "fleet-simulator";
    heartbeat.utime = executor_.Now() - age_s * bus::kSecond;
    station_.Publish(bus::channel::kHeartbeat, heartbeat);
  }
  Run(5);
  EXPECT_FALSE(Alarm());
}

TEST_F(MonitorClocks, AreToldWhenThatOfTheHostIsSet) {
  Start();
  const auto alarm = [&] { return std::ranges::find(alarms_, "wall-clock", &alarm_t::condition); };
  Run(5);
  EXPECT_EQ(alarm(), alarms_.end());
  executor_.SetWallAhead(-3600 * bus::kSecond);
  Run(3);
  ASSERT_NE(alarm(), alarms_.end());
  EXPECT_TRUE(alarm()->text.starts_with("the clock of the monitor's host was set back by 3600.0 s"))
      << alarm()->text;
  executor_.SetWallAhead(0);
  Run(3);
  ASSERT_NE(alarm(), alarms_.end());
  EXPECT_EQ(alarm()->state, alarm_t::ENDED);
}

}  // namespace
}  // namespace skein::monitor

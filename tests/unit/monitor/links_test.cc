#include <cmath>
#include <utility>

#include "unit/monitor/monitor_fixture.h"

namespace skein::monitor {
namespace {

constexpr int kUp = link_status_t::LINK_UP;
constexpr int kLate = link_status_t::LINK_LATE;
constexpr int kLost = link_status_t::LINK_LOST;
constexpr int kUnknown = link_status_t::LINK_UNKNOWN;

class MonitorLinks : public testing::MonitorTest {
 protected:
  MonitorLinks() {
    fleet_.Add(1, 0, 0, 1000);
    fleet_.Add(2, 0, 2000, 1000);
    fleet_.Add(3, 0, -2000, 1000);
  }
  double Seconds() const { return bus::ToSeconds(executor_.Now() - bus::SimulatedExecutor::kStart); }
};

TEST_F(MonitorLinks, AreUpWithoutAnEvent) {
  Start();
  Run(60);
  EXPECT_TRUE(heard_.events.empty());
  for (const int id : {1, 2, 3}) {
    EXPECT_EQ(heard_.Link(id)->downlink, kUp);
    EXPECT_EQ(heard_.Link(id)->uplink, kUp);
    EXPECT_EQ(heard_.Link(id)->horizontal_uncertainty_m, 0);
  }
}

TEST_F(MonitorLinks, LeapOfAUavIsToldOnceInTenSeconds) {
  Start();
  Run(20);
  fleet_.uavs[2].start.north_m += 5000;
  Run(5);
  ASSERT_EQ(heard_.Events("position_leapt").size(), 1u);
  const event_t leap = heard_.Events("position_leapt")[0];
  EXPECT_EQ(leap.vehicle_id, 2);
  EXPECT_EQ(leap.severity, event_t::CAUTION);
  EXPECT_EQ(leap.text.substr(0, 50), "UAV2 is 5000 m from where it was 0.05 s before: it");
  fleet_.uavs[2].start.north_m -= 5000;
  Run(3);
  EXPECT_EQ(heard_.Events("position_leapt").size(), 1u);
  Run(10);
  fleet_.uavs[2].start.north_m += 5000;
  Run(3);
  EXPECT_EQ(heard_.Events("position_leapt").size(), 2u);
}

TEST_F(MonitorLinks, EveryLeapAndEveryTimeThatCannotBeAreCounted) {
  Start();
  Run(20);
  std::int64_t counted = monitor_bus_.statistics().undecodable;
  const auto more = [&] {
    return monitor_bus_.statistics().undecodable -
           std::exchange(counted, monitor_bus_.statistics().undecodable);
  };
  EXPECT_EQ(counted, 0);
  for (int i = 0; i < 5; ++i) {
    fleet_.uavs[2].start.north_m += 5000;
    Run(0.05);
  }
  EXPECT_EQ(heard_.Events("position_leapt").size(), 1u);
  EXPECT_EQ(more(), 5);
  Run(10);
  for (const double off_s : {-86'400.0, 86'400.0, -5.0}) {
    heard_.events.clear();
    for (int i = 0; i < 3; ++i) {
      fleet_.uavs[3].clock_off_s = off_s;
      Run(0.05);
      fleet_.uavs[3].clock_off_s = 0;
      Run(0.2);
    }
    EXPECT_EQ(heard_.Events("time_jumped").size(), 1u) << off_s;
    EXPECT_EQ(heard_.Events("time_jumped").size(), heard_.events.size()) << off_s;
    EXPECT_GE(more(), 3) << off_s;
    Run(15);
    EXPECT_EQ(more(), 0) << off_s;
    EXPECT_EQ(heard_.Link(3)->downlink, kUp);
  }
}

TEST_F(MonitorLinks, OfAUavWhoseClockIsOffForGoodAreUp) {
  fleet_.uavs[3].clock_off_s = 86'400;
  fleet_.uavs[2].clock_off_s = -86'400;
  Start();
  Run(30);
  EXPECT_TRUE(heard_.events.empty());
  EXPECT_EQ(monitor_bus_.statistics().undecodable, 0);
  for (const int id : {1, 2, 3}) EXPECT_EQ(heard_.Link(id)->downlink, kUp);
}

TEST_F(MonitorLinks, AreTold1HzWhileNothingChanges) {
  Start();
  Run(10);
  const std::size_t before = heard_.links.size();
  Run(10);
  EXPECT_EQ(heard_.links.size() - before, 10u);
  EXPECT_EQ(heard_.links.back().sequence, heard_.links[before].sequence + 9);
}

TEST_F(MonitorLinks, LossIsToldOnceWithinFiveSecondsAndReturnOnce) {
  Start();
  Run(20.03);
  fleet_.uavs[3].downlink = fleet_.uavs[3].uplink = false;
  Run(35);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  const event_t lost = heard_.Events("link_lost")[0];
  EXPECT_EQ(lost.vehicle_id, 3);
  EXPECT_EQ(lost.severity, event_t::WARNING);
  EXPECT_EQ(lost.text.substr(0, 40), "link of UAV3 lost: nothing heard for 4.0");
  EXPECT_LE(bus::ToSeconds(lost.utime - bus::SimulatedExecutor::kStart), 25.03);
  EXPECT_EQ(heard_.Link(3)->downlink, kLost);
  EXPECT_EQ(heard_.Link(3)->uplink, kLost);
  EXPECT_EQ(heard_.Link(2)->downlink, kUp);
  EXPECT_TRUE(heard_.Events("link_restored").empty());

  fleet_.uavs[3].downlink = fleet_.uavs[3].uplink = true;
  const double back = Seconds();
  Run(30);
  ASSERT_EQ(heard_.Events("link_restored").size(), 1u);
  const double restored =
      bus::ToSeconds(heard_.Events("link_restored")[0].utime - bus::SimulatedExecutor::kStart);
  EXPECT_GE(restored - back, 3);
  EXPECT_LE(restored - back, 3.5);
  EXPECT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_EQ(heard_.Events("link_late").size(), 1u);
  EXPECT_EQ(heard_.events.size(), 3u);
  EXPECT_EQ(heard_.Link(3)->downlink, kUp);
  EXPECT_EQ(heard_.Link(3)->uplink, kUp);
}

TEST_F(MonitorLinks, AreNotJudgedByCommandsToAnotherFleet) {
  Start();
  Run(10);
  // A recording of a later controller, played on this bus: no UAV here ever obeys it.
  executor_.Every(50'000, [this] {
    fleet_command_t command;
    command.utime = executor_.Now();
    command.session_id = 1000;
    command.to_session_id = testing::FakeFleet::kSession + 1;
    for (const int id : {1, 2, 3}) command.commands.emplace_back().id = id;
    bus::PublishChunks(station_, bus::channel::kCmdFleet, command);
  });
  Run(20);
  EXPECT_TRUE(heard_.events.empty());
  for (const int id : {1, 2, 3}) EXPECT_EQ(heard_.Link(id)->uplink, kUp);
}

TEST_F(MonitorLinks, UplinkThatReturnsATickLaterIsPartOfOneReturn) {
  Start();
  Run(15);
  fleet_.uavs[3].uplink = false;
  Run(5.08);
  fleet_.uavs[3].downlink = false;
  Run(35);
  EXPECT_EQ(heard_.Events("link_lost").size(), 2u);
  // From here the check falls between the return of the downlink and that of the uplink.
  fleet_.uavs[3].downlink = fleet_.uavs[3].uplink = true;
  Run(10);
  EXPECT_EQ(heard_.Events("link_lost").size(), 2u);
  EXPECT_EQ(heard_.Events("link_restored").size(), 1u);
}

TEST_F(MonitorLinks, ChangesAreInLinkStatusAtOnce) {
  Start();
  Run(20);
  fleet_.uavs[3].downlink = false;
  Run(10);
  const auto lost = heard_.Events("link_lost").at(0).utime;
  bool told = false;
  for (const auto& status : heard_.links)
    told = told || (status.utime == lost && status.links[2].downlink == kLost);
  EXPECT_TRUE(told);
}

TEST_F(MonitorLinks, LossOfTheUplinkAloneIsToldAsSuch) {
  Start();
  Run(20);
  fleet_.uavs[2].uplink = false;
  Run(10);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_EQ(heard_.Events("link_lost")[0].text.substr(0, 42), "uplink of UAV2 lost: commands not obeyed f");
  EXPECT_EQ(heard_.Link(2)->downlink, kUp);
  EXPECT_EQ(heard_.Link(2)->uplink, kLost);
  EXPECT_NEAR(heard_.Link(2)->uplink_age_s, 10, 1.1);
}

TEST_F(MonitorLinks, FrozenLinkIsLostAndSaidToRepeatItself) {
  Start();
  Run(20);
  fleet_.uavs[1].frozen = true;
  Run(5);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_NE(heard_.Events("link_lost")[0].text.find("repeats its state"), std::string::npos);
}

TEST_F(MonitorLinks, DownlinkThatReturnsWithoutItsUplinkIsToldAsStillLost) {
  Start();
  Run(20);
  fleet_.uavs[3].downlink = fleet_.uavs[3].uplink = false;
  Run(20);
  fleet_.uavs[3].downlink = true;
  Run(10);
  ASSERT_EQ(heard_.Events("link_lost").size(), 2u);
  EXPECT_EQ(heard_.Events("link_lost")[1].text.substr(0, 40), "downlink of UAV3 is back, but not its up");
  EXPECT_TRUE(heard_.Events("link_restored").empty());
  fleet_.uavs[3].uplink = true;
  Run(5);
  EXPECT_EQ(heard_.Events("link_restored").size(), 1u);
}

TEST_F(MonitorLinks, UplinksAreNotJudgedWhenNobodyCommands) {
  fleet_.commands = false;
  Start();
  Run(30);
  EXPECT_TRUE(heard_.events.empty());
  EXPECT_EQ(heard_.Link(1)->uplink, kUnknown);
  EXPECT_EQ(heard_.Link(1)->uplink_age_s, -1);
}

TEST_F(MonitorLinks, AreAllUpThroughARestartOfTheController) {
  Start();
  Run(20);
  fleet_.commands = false;
  Run(2);
  fleet_.commands = true;
  Run(20);
  EXPECT_TRUE(heard_.events.empty());
  EXPECT_EQ(heard_.Link(1)->uplink, kUp);
}

TEST_F(MonitorLinks, NeverHeardIsUnknownForFiveSecondsThenLost) {
  fleet_.uavs[3].downlink = false;
  Start();
  Run(4.5);
  EXPECT_TRUE(heard_.events.empty());
  EXPECT_EQ(heard_.Link(3)->downlink, kUnknown);
  EXPECT_EQ(heard_.Link(3)->downlink_age_s, -1);
  Run(1.5);
  EXPECT_EQ(heard_.Link(3)->downlink, kLost);
  ASSERT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_EQ(heard_.Events("link_lost")[0].text, "link of UAV3 lost: never heard");
  EXPECT_FALSE(heard_.Proximity(3));
}

TEST_F(MonitorLinks, LateMonitorSeesWhatIsUpAndWhatIsLost) {
  fleet_.uavs[1].frozen = true;
  fleet_.uavs[2].downlink = false;
  Run(60);
  Start();
  Run(1);
  EXPECT_EQ(heard_.Link(3)->downlink, kUp);
  EXPECT_EQ(heard_.Link(3)->uplink, kUp);
  EXPECT_EQ(heard_.Link(1)->downlink, kUnknown);
  Run(10);
  EXPECT_EQ(heard_.Link(1)->downlink, kLost);
  EXPECT_EQ(heard_.Link(2)->downlink, kLost);
  EXPECT_EQ(heard_.events.size(), heard_.Events("link_lost").size());
  EXPECT_EQ(heard_.events.size(), 2u);
}

TEST_F(MonitorLinks, LostUavIsDeadReckonedWithGrowingUncertainty) {
  Start();
  Run(20);
  fleet_.uavs[3].downlink = false;
  Run(2.5);
  EXPECT_EQ(heard_.Link(3)->downlink, kLate);
  Run(27.5);
  const auto link = *heard_.Link(3);
  const double age = link.downlink_age_s;
  EXPECT_NEAR(age, 30, 0.2);
  EXPECT_NEAR(link.horizontal_uncertainty_m, 2 * age, 0.01);
  EXPECT_NEAR(link.vertical_uncertainty_m, age, 0.01);
  EXPECT_NEAR(link.estimated_east_m,
              50 * bus::ToSeconds(heard_.links.back().utime - bus::SimulatedExecutor::kStart), 1e-3);
  EXPECT_NEAR(link.estimated_north_m, -2000, 1e-6);
}

TEST_F(MonitorLinks, UavThatLeavesTheRosterIsForgottenWithoutAnEvent) {
  Start();
  Run(20);
  fleet_.uavs.erase(3);
  Run(20);
  EXPECT_TRUE(heard_.events.empty());
  EXPECT_FALSE(heard_.Link(3));
  EXPECT_FALSE(heard_.Proximity(3));
}

TEST_F(MonitorLinks, UavOfNoRosterIsWatchedWhileItIsHeard) {
  fleet_.Add(8, 0, 5000, 1000).in_roster = false;
  Start();
  Run(20);
  EXPECT_EQ(heard_.Link(8)->downlink, kUp);
  EXPECT_TRUE(heard_.Proximity(8));
  fleet_.uavs.erase(8);
  Run(10);
  EXPECT_FALSE(heard_.Link(8));
  EXPECT_EQ(heard_.Events("link_lost").size(), 0u);
}

TEST_F(MonitorLinks, SilenceOfTheWholeBusIsNoticedToo) {
  Start();
  Run(20);
  fleet_.telemetry = false;
  Run(5);
  for (const int id : {1, 2, 3}) EXPECT_EQ(heard_.Link(id)->downlink, kLost);
  EXPECT_EQ(heard_.Events("fleet_silent").size(), 1u);
  EXPECT_TRUE(heard_.Events("link_lost").empty()) << "one cause, one event";
}

}  // namespace
}  // namespace skein::monitor

#include <unistd.h>

#include <filesystem>
#include <map>
#include <skein/ack_t.hpp>
#include <skein/alarm_command_t.hpp>
#include <skein/alarm_list_t.hpp>
#include <skein/heartbeat_t.hpp>

#include "unit/monitor/monitor_fixture.h"

namespace skein::monitor {
namespace {

constexpr int kUnacknowledged = alarm_t::UNACKNOWLEDGED;
constexpr int kAcknowledged = alarm_t::ACKNOWLEDGED;
constexpr int kEnded = alarm_t::ENDED;
constexpr int kShelved = alarm_t::SHELVED;
constexpr int kOver = alarm_t::OVER;

class MonitorAlarms : public testing::MonitorTest {
 protected:
  MonitorAlarms() {
    fleet_.Add(1, 0, 0, 1000);
    fleet_.Add(2, 0, 2000, 1000);
    fleet_.Add(3, 0, -2000, 1000);
    bus::SubscribeChunks<alarm_list_t>(station_, bus::channel::kAlarms,
                                       [this](const alarm_list_t& list, int) { lists_.push_back(list); });
    station_.Subscribe<ack_t>(bus::channel::kAck, [this](const ack_t& ack) { acks_.push_back(ack); });
  }

  void SetLink(int id, bool up) { fleet_.uavs[id].downlink = fleet_.uavs[id].uplink = up; }

  /// The latest occurrence of a condition.
  std::optional<alarm_t> Find(const std::string& condition) const {
    std::optional<alarm_t> found;
    for (const alarm_t& alarm : lists_.back().alarms) {
      if (alarm.condition == condition && (!found || alarm.id > found->id)) found = alarm;
    }
    return found;
  }
  int StateOf(const std::string& condition) const {
    const auto alarm = Find(condition);
    return alarm ? alarm->state : -1;
  }

  alarm_command_t Command(std::int8_t action) const {
    alarm_command_t command;
    command.session_id = 7;
    command.to_session_id = lists_.back().session_id;
    command.action = action;
    command.operator_name = "Ann";
    command.alarm_session_id = lists_.back().session_id;
    return command;
  }
  /// Sends a command and returns the answer.
  ack_t Ask(alarm_command_t command) {
    command.request_id = ++request_id_;
    command.num_alarm_ids = static_cast<int>(command.alarm_ids.size());
    station_.Publish(bus::channel::kCmdAlarm, command);
    Run(0.3);
    return acks_.back();
  }
  ack_t Acknowledge(std::int64_t id) {
    alarm_command_t command = Command(alarm_command_t::ACTION_ACKNOWLEDGE);
    command.alarm_ids = {id};
    return Ask(command);
  }

  std::vector<alarm_list_t> lists_;
  std::vector<ack_t> acks_;
  std::int64_t request_id_ = 0;
};

TEST_F(MonitorAlarms, AreNoneWhileAllIsWellAndToldOnceASecond) {
  Start();
  Run(20);
  EXPECT_TRUE(lists_.back().alarms.empty());
  EXPECT_EQ(lists_.back().newest_id, 0);
  EXPECT_NEAR(static_cast<double>(lists_.size()), 20, 1);
}

TEST_F(MonitorAlarms, TellALostLinkFirstAsLateThenAsLostAndItsEnd) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(3);
  EXPECT_EQ(Find("link:3")->severity, event_t::CAUTION);
  EXPECT_EQ(Find("link:3")->text.substr(0, 17), "link of UAV3 late");
  Run(3);
  const alarm_t lost = *Find("link:3");
  EXPECT_EQ(lost.severity, event_t::WARNING);
  EXPECT_EQ(lost.state, kUnacknowledged);
  EXPECT_EQ(lost.vehicle_id, 3);
  EXPECT_EQ(lost.text.substr(0, 40), "link of UAV3 lost: nothing heard for 4.0");
  EXPECT_EQ(lists_.back().num_warnings, 1);
  EXPECT_EQ(lists_.back().num_unacknowledged_warnings, 1);

  SetLink(3, true);
  Run(6);
  EXPECT_EQ(StateOf("link:3"), kEnded);
  EXPECT_EQ(lists_.back().num_warnings, 0);
  EXPECT_EQ(lists_.back().num_unacknowledged_warnings, 1);
  EXPECT_TRUE(Acknowledge(lost.id).accepted);
  EXPECT_EQ(StateOf("link:3"), kOver);
  EXPECT_EQ(lists_.back().num_unacknowledged_warnings, 0);
}

TEST_F(MonitorAlarms, AreAcknowledgedByNameWithAnAckAndAnEvent) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(6);
  const ack_t ack = Acknowledge(Find("link:3")->id);
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.node, "collision-monitor");
  EXPECT_EQ(StateOf("link:3"), kAcknowledged);
  EXPECT_EQ(Find("link:3")->acknowledged_by, "Ann");
  ASSERT_EQ(heard_.Events("alarm_acknowledged").size(), 1u);
  EXPECT_EQ(heard_.Events("alarm_acknowledged")[0].text.substr(0, 36),
            "acknowledged by Ann: link of UAV3 lo");
  EXPECT_EQ(Acknowledge(Find("link:3")->id).reason,
            "alarm " + std::to_string(Find("link:3")->id) + " was acknowledged before");

  SetLink(3, true);
  Run(6);
  EXPECT_EQ(StateOf("link:3"), kOver);
  SetLink(3, false);
  Run(6);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged) << "it came back, and nobody has seen that";
}

TEST_F(MonitorAlarms, AreAcknowledgedTogetherAsFarAsTheOperatorSawThem) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(6);
  alarm_command_t all = Command(alarm_command_t::ACTION_ACKNOWLEDGE);
  all.all_up_to_id = lists_.back().newest_id;
  SetLink(2, false);
  Run(6);
  EXPECT_TRUE(Ask(all).accepted);
  EXPECT_EQ(StateOf("link:3"), kAcknowledged);
  EXPECT_EQ(StateOf("link:2"), kUnacknowledged);
}

TEST_F(MonitorAlarms, RefuseWhatCannotBeMeant) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(6);
  EXPECT_EQ(Acknowledge(99).reason, "there is no alarm 99");
  alarm_command_t old = Command(alarm_command_t::ACTION_ACKNOWLEDGE);
  old.alarm_session_id = 1;
  old.alarm_ids = {1};
  EXPECT_EQ(Ask(old).reason, "the alarms have been numbered anew since: look at them again");
  alarm_command_t shelve = Command(alarm_command_t::ACTION_SHELVE);
  shelve.alarm_ids = {Find("link:3")->id};
  shelve.duration_s = 1e6;
  EXPECT_EQ(Ask(shelve).reason, "an alarm can be shelved for 1 to 3600 s, not 1e+06");
  EXPECT_EQ(Ask(Command(alarm_command_t::ACTION_ACKNOWLEDGE)).reason, "no alarm is named");
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);
}

TEST_F(MonitorAlarms, AreShelvedForATime) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(6);
  alarm_command_t shelve = Command(alarm_command_t::ACTION_SHELVE);
  shelve.alarm_ids = {Find("link:3")->id};
  shelve.duration_s = 60;
  EXPECT_TRUE(Ask(shelve).accepted);
  EXPECT_EQ(StateOf("link:3"), kShelved);
  EXPECT_EQ(lists_.back().num_warnings, 0);
  Run(61);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);

  EXPECT_TRUE(Ask(shelve).accepted);
  shelve.action = alarm_command_t::ACTION_UNSHELVE;
  EXPECT_TRUE(Ask(shelve).accepted);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);
}

TEST_F(MonitorAlarms, RiseAgainUnacknowledgedAfterARestart) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(6);
  Acknowledge(Find("link:3")->id);
  node_.reset();
  Start();
  Run(8);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);
}

TEST_F(MonitorAlarms, AreAsTheyWereAfterARestartWithAStateFile) {
  CollisionMonitorOptions options;
  options.state_file =
      std::filesystem::temp_directory_path() / ("skein_monitor_" + std::to_string(::getpid()));
  Start(options);
  Run(10);
  SetLink(3, false);
  SetLink(2, false);
  Run(6);
  const std::int64_t id = Find("link:3")->id;
  Acknowledge(id);
  node_.reset();
  SetLink(2, true);
  lists_.clear();
  Start(options);
  Run(1);
  EXPECT_EQ(StateOf("link:3"), kAcknowledged);
  Run(12);
  EXPECT_EQ(StateOf("link:3"), kAcknowledged) << "it was found lost once more";
  EXPECT_EQ(Find("link:3")->id, id);
  EXPECT_EQ(StateOf("link:2"), kEnded);
  node_.reset();  // it keeps its state once more
  std::filesystem::remove(options.state_file);
}

TEST_F(MonitorAlarms, TellPairsThatComeTooClose) {
  fleet_.Add(4, 3000, 0, 1000, 50, 3.14159265);  // head-on to UAV 1
  Start();
  Run(8);
  EXPECT_EQ(Find("proximity:1-4")->severity, event_t::CAUTION);
  EXPECT_EQ(Find("proximity:1-4")->other_vehicle_id, 4);
  Run(19);
  EXPECT_EQ(Find("proximity:1-4")->severity, event_t::WARNING);
  Run(60);
  EXPECT_EQ(StateOf("proximity:1-4"), kEnded);
}

TEST_F(MonitorAlarms, DoNotMissANodeThatWasHeardOnce) {
  Start();
  heartbeat_t heartbeat{};
  heartbeat.utime = executor_.Now();
  heartbeat.heartbeat_node = "fleet-simulat5r";
  station_.Publish(bus::channel::kHeartbeat, heartbeat);
  Run(10);
  EXPECT_FALSE(Find("node_silent:fleet-simulat5r"));
}

TEST_F(MonitorAlarms, TellANodeThatHasFallenSilent) {
  bool alive = true;
  executor_.Every(bus::kSecond, [&] {
    heartbeat_t heartbeat{};
    heartbeat.utime = executor_.Now();
    heartbeat.heartbeat_node = "formation-controller";
    if (alive) station_.Publish(bus::channel::kHeartbeat, heartbeat);
  });
  Start();
  Run(10);
  EXPECT_FALSE(Find("node_silent:formation-controller"));
  alive = false;
  Run(5);
  EXPECT_EQ(Find("node_silent:formation-controller")->severity, event_t::WARNING);
  alive = true;
  Run(2);
  EXPECT_EQ(StateOf("node_silent:formation-controller"), kEnded);
}

TEST_F(MonitorAlarms, SayNothingOfASilenceInWhichTheMonitorItselfWasStopped) {
  Start();
  executor_.Every(bus::kSecond, [&] {
    heartbeat_t heartbeat{};
    heartbeat.utime = executor_.Now();
    heartbeat.heartbeat_node = "formation-controller";
    station_.Publish(bus::channel::kHeartbeat, heartbeat);
  });
  Run(10);
  // Its timers are the first that run when it goes on.
  executor_.SkipTo(executor_.Now() + 10 * bus::kSecond);
  for (int i = 0; i < 100; ++i) {
    Run(0.1);
    EXPECT_FALSE(Find("node_silent:formation-controller"));
    EXPECT_FALSE(Find("fleet_silent"));
    EXPECT_FALSE(Find("link:1"));
  }
}

TEST_F(MonitorAlarms, TellThatTheSourceOfTheFleetIsSilent) {
  Start();
  Run(10);
  fleet_.telemetry = false;
  Run(4);
  EXPECT_EQ(StateOf("fleet_silent"), kUnacknowledged);
  fleet_.telemetry = true;
  Run(2);
  EXPECT_EQ(StateOf("fleet_silent"), kEnded);
}

TEST_F(MonitorAlarms, OfASilentFleetStayWhenTheMonitorStartsAnew) {
  CollisionMonitorOptions options;
  options.state_file =
      std::filesystem::temp_directory_path() / ("skein_monitor_silent_" + std::to_string(::getpid()));
  Start(options);
  Run(10);
  SetLink(3, false);
  Run(6);
  fleet_.telemetry = false;
  Run(4);
  Acknowledge(Find("fleet_silent")->id);
  node_.reset();
  lists_.clear();
  Start(options);
  Run(15);
  EXPECT_EQ(StateOf("fleet_silent"), kAcknowledged);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);
  fleet_.telemetry = true;
  Run(2);
  EXPECT_EQ(StateOf("fleet_silent"), kOver);
  node_.reset();  // it keeps its state once more
  std::filesystem::remove(options.state_file);
}

TEST_F(MonitorAlarms, OfALostLinkComeThoughTheTelemetryOfAllStutters) {
  Start();
  Run(10);
  SetLink(3, false);
  for (int i = 0; i < 5; ++i) {
    fleet_.telemetry = false;
    Run(1.6);
    fleet_.telemetry = true;
    Run(2.4);
  }
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged);
}

TEST_F(MonitorAlarms, TellOfANodeAfterAHundredInventedOnes) {
  Start();
  heartbeat_t heartbeat{};
  for (int i = 0; i < 100; ++i) {
    heartbeat.utime = executor_.Now();
    heartbeat.heartbeat_node = "invented-" + std::to_string(i);
    station_.Publish(bus::channel::kHeartbeat, heartbeat);
  }
  Run(5);
  heartbeat.heartbeat_node = "formation-controller";
  for (int i = 0; i < 5; ++i) {
    heartbeat.utime = executor_.Now();
    station_.Publish(bus::channel::kHeartbeat, heartbeat);
    Run(1);
  }
  Run(5);
  EXPECT_EQ(StateOf("node_silent:formation-controller"), kUnacknowledged);
}

TEST_F(MonitorAlarms, AreOneWhenTheSourceOfAHundredLinksIsSilent) {
  for (int id = 4; id <= 100; ++id) fleet_.Add(id, 0, 2000.0 * id, 1000);
  Start();
  Run(10);
  fleet_.telemetry = false;
  Run(30);
  ASSERT_EQ(lists_.back().alarms.size(), 1u);
  EXPECT_EQ(lists_.back().alarms[0].text,
            "no telemetry from any of 100 UAVs: the source of FLEET_STATE has fallen silent");
  EXPECT_EQ(heard_.Link(50)->downlink, link_status_t::LINK_LOST) << "it is told as one, and known of each";
  EXPECT_EQ(heard_.events.size(), 1u);
  EXPECT_EQ(heard_.Events("fleet_silent").size(), 1u);

  SetLink(3, false);
  fleet_.telemetry = true;
  Run(6);
  EXPECT_EQ(StateOf("fleet_silent"), kEnded);
  EXPECT_EQ(StateOf("link:3"), kUnacknowledged) << "the fleet is back, and this one is not";
  EXPECT_EQ(Find("link:3")->severity, event_t::WARNING);
  EXPECT_EQ(Find("link:3")->text.substr(0, 39), "link of UAV3 lost: nothing heard for 34");
  EXPECT_EQ(lists_.back().alarms.size(), 2u);
  EXPECT_EQ(heard_.Events("link_lost").size(), 1u);
  EXPECT_TRUE(heard_.Events("link_restored").empty()) << "whose loss was not told";

  SetLink(3, true);
  Run(6);
  EXPECT_EQ(StateOf("link:3"), kEnded);
  EXPECT_EQ(heard_.Events("link_restored").size(), 1u);
}

TEST_F(MonitorAlarms, OfALinkThatWasToldBeforeTheFleetFellSilentStay) {
  Start();
  Run(10);
  SetLink(3, false);
  Run(3);
  EXPECT_EQ(Find("link:3")->severity, event_t::CAUTION);
  fleet_.telemetry = false;
  Run(10);
  EXPECT_EQ(Find("link:3")->severity, event_t::WARNING);
  EXPECT_EQ(StateOf("link:2"), -1);
  SetLink(3, true);
  fleet_.telemetry = true;
  Run(6);
  EXPECT_EQ(StateOf("link:3"), kEnded);
  SetLink(2, false);
  Run(3);
  EXPECT_EQ(Find("link:2")->severity, event_t::CAUTION) << "one by one again";
}

TEST_F(MonitorAlarms, OfAThousandUavsAreCountedButNotAllListed) {
  for (int id = 4; id <= 1000; ++id) fleet_.Add(id, 0, 2000.0 * id, 1000);
  Start();
  Run(10);
  for (int id = 1; id <= 1000; ++id) SetLink(id, false);
  const std::size_t before = lists_.size();
  Run(8);
  EXPECT_EQ(lists_.back().num_warnings, 1000);
  EXPECT_EQ(lists_.back().alarms.size(), 350u);  // and the history
  EXPECT_EQ(lists_.back().num_not_listed, 700);
  EXPECT_LE(lists_.size() - before, 12u);
  alarm_command_t all = Command(alarm_command_t::ACTION_ACKNOWLEDGE);
  all.all_up_to_id = lists_.back().newest_id;
  EXPECT_TRUE(Ask(all).accepted);
  EXPECT_EQ(lists_.back().num_unacknowledged_warnings, 0);
}

}  // namespace
}  // namespace skein::monitor

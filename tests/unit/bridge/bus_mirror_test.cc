#include "bridge/bus_mirror.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/heartbeat.h"
#include "bus/simulated_executor.h"
#include "frame_reader.h"

namespace skein::bridge {
namespace {

namespace channel = bus::channel;

class BusMirrorTest : public testing::Test {
 protected:
  bus::Utime Now() const { return executor_.Now(); }

  fleet_roster_t Roster(int count, std::int64_t session_id = 1) const {
    fleet_roster_t roster{};
    roster.utime = Now();
    roster.session_id = session_id;
    roster.scenario = "Test";
    roster.start_utime = bus::SimulatedExecutor::kStart;
    for (int id = 1; id <= count; ++id) {
      roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel{}, true));
    }
    return roster;
  }
  void SendState(int count) {
    fleet_state_t state{};
    state.utime = Now();
    state.session_id = 1;
    state.tick = tick_++;
    for (int id = 1; id <= count; ++id) {
      vehicle_state_t vehicle = bus::ToMessage(VehicleState{.east_m = 100. * id, .speed_m_s = 50});
      vehicle.utime = Now();
      vehicle.id = id;
      state.vehicles.push_back(vehicle);
    }
    bus::PublishChunks(others_, channel::kFleetState, state);
    executor_.Deliver();
  }
  formation_t Formation() const {
    formation_t formation{};
    formation.utime = Now();
    formation.formation_id = 1;
    formation.control = "skein";
    formation.shape = "custom";
    bus::SetProximityLimits(formation, {});
    return formation;
  }
  void SendFormation() {
    others_.Publish(channel::kFormation, Formation());
    executor_.Deliver();
  }
  void SendStatus(double leader_arc_m, std::int8_t mode = formation_status_t::MODE_IN_FORMATION) {
    formation_status_t status{};
    status.utime = Now();
    status.formation_id = 1;
    status.mode = mode;
    status.tick = tick_++;
    status.leader_arc_m = leader_arc_m;
    slot_status_t slot{};
    slot.vehicle_id = 1;
    slot.forward_error_m = 5;
    status.slots = {slot};
    bus::PublishChunks(others_, channel::kFormationStatus, status);
    executor_.Deliver();
  }
  void SendLinks(std::int8_t downlink) {
    link_status_t links{};
    links.utime = Now();
    links.sequence = sequence_++;
    vehicle_link_t link{};
    link.id = 1;
    link.downlink = downlink;
    links.links = {link};
    bus::PublishChunks(others_, channel::kLinkStatus, links);
    executor_.Deliver();
  }
  void SendEvent(const std::string& text) {
    event_t event{};
    event.event_node = "formation-controller";
    event.code = "test";
    event.text = text;
    others_.Publish(channel::kEvent, event);
  }

  /// Text frames of a type since the last call of Forget().
  std::vector<Json> Texts(const std::string& type) const {
    std::vector<Json> found;
    for (const LiveFrame& frame : frames_) {
      if (frame.binary) continue;
      Json text = Json::parse(*frame.bytes);
      if (text["type"] == type) found.push_back(text);
    }
    return found;
  }
  int Count(unsigned char kind) const {
    int count = 0;
    for (const LiveFrame& frame : frames_) count += frame.binary && frame.bytes->front() == kind;
    return count;
  }
  void Forget() { frames_.clear(); }

  std::shared_ptr<lcm::LCM> transport_ = std::make_shared<lcm::LCM>("memq://");
  bus::SimulatedExecutor executor_{transport_};
  bus::Bus bus_{transport_, "web-bridge", executor_};
  bus::Bus others_{transport_, "formation-controller", executor_};
  std::vector<LiveFrame> frames_;
  BusMirror mirror_{bus_, {"0.1.0", "memq://", "", ""}, [this](const LiveFrame& frame) {
                      frames_.push_back(Unpacked(frame));
                    }};
  std::int64_t tick_ = 0;
  std::int64_t sequence_ = 0;
};

TEST_F(BusMirrorTest, TellsOfTheRecordingButNotWhatIsOldToThoseWhoComeLater) {
  recording_status_t status;
  status.state = recording_status_t::RECORDING;
  status.folder = "/logs";
  status.recording = "flight.lcm";
  others_.Publish(channel::kRecording, status);
  executor_.Deliver();
  ASSERT_EQ(Texts("recording").size(), 1u);
  EXPECT_EQ(Texts("recording")[0]["recording"], "flight.lcm");
  const auto in_snapshot = [&] {
    return std::ranges::any_of(mirror_.Snapshot(), [](const LiveFrame& frame) {
      return !frame.binary && Json::parse(*frame.bytes)["type"] == "recording";
    });
  };
  EXPECT_TRUE(in_snapshot());
  executor_.RunFor(BusMirror::kSilentAfter);
  EXPECT_FALSE(in_snapshot());
  EXPECT_TRUE(mirror_.State()["recording"].is_null());
}

TEST_F(BusMirrorTest, TellsTheRosterOnceAndAgainWhenItChanges) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(300));
  executor_.Deliver();
  ASSERT_EQ(Texts("roster").size(), 1u);
  EXPECT_EQ(Texts("roster")[0]["vehicles"].size(), 300u);
  EXPECT_EQ(Texts("roster")[0]["vehicles"][299]["callsign"], "UAV300");
  executor_.RunFor(bus::kSecond);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(300));
  executor_.Deliver();
  EXPECT_EQ(Texts("roster").size(), 1u);
  executor_.RunFor(bus::kSecond);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(3, 2));
  executor_.Deliver();
  ASSERT_EQ(Texts("roster").size(), 2u);
  EXPECT_EQ(mirror_.Vehicles()["vehicles"].size(), 3u);
}

TEST_F(BusMirrorTest, SendsMotionTenTimesASecondAndHalfAsOftenAboveOneHundred) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(3));
  SendState(3);
  Forget();
  executor_.RunFor(bus::kSecond);
  EXPECT_EQ(Count(kMotionKind), 10);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(101, 2));
  executor_.Deliver();
  Forget();
  executor_.RunFor(bus::kSecond);
  EXPECT_EQ(Count(kMotionKind), 5);
}

TEST_F(BusMirrorTest, SendsTheStatusesOfALargeFleetTogetherButAnotherModeAtOnce) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(101));
  SendFormation();
  SendStatus(0);
  Forget();
  for (int i = 0; i < 20; ++i) {
    SendStatus(10. * i);
    executor_.RunFor(bus::kSecond / 10);
  }
  EXPECT_TRUE(Texts("status").empty());
  const auto together = Texts("statuses");
  ASSERT_EQ(together.size(), 2u);
  EXPECT_EQ(together.back()["statuses"][0]["formation_id"], 1);
  SendStatus(200, formation_status_t::MODE_AVOIDING);
  ASSERT_EQ(Texts("status").size(), 1u);
  EXPECT_EQ(Texts("status")[0]["mode"], formation_status_t::MODE_AVOIDING);
}

TEST_F(BusMirrorTest, CountsTimeFromTheScenariosStartAndAgeFromWhenItHeard) {
  executor_.RunFor(10 * bus::kSecond);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(1));
  SendState(1);
  Forget();
  executor_.RunFor(bus::kSecond + bus::kBetweenTicks);
  ASSERT_FALSE(frames_.empty());
  FrameReader frame(*frames_.back().bytes);
  for (const LiveFrame& last : frames_) {
    if (last.binary && last.bytes->front() == kMotionKind) frame = FrameReader(*last.bytes);
  }
  EXPECT_DOUBLE_EQ(frame.t_s, 10);
  EXPECT_EQ(frame.Ints(), std::vector<std::int32_t>{1});
  for (int column = 0; column < 6; ++column) frame.Floats();
  EXPECT_NEAR(frame.Floats()[0], 1.025, 1.0 / 32) << "ages are rounded";
}

TEST_F(BusMirrorTest, KeepsTheFlightSoFarUntilAnotherOneStarts) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(2));
  for (int i = 0; i < 10; ++i) {
    SendState(2);
    executor_.RunFor(bus::kSecond);
  }
  EXPECT_EQ(mirror_.FlightSoFar().size(), 10u);
  EXPECT_EQ(mirror_.FlightSoFar().back()->rows.size(), 2u);
  EXPECT_EQ(mirror_.start_utime(), bus::SimulatedExecutor::kStart);
  fleet_roster_t another = Roster(2, 2);
  another.start_utime = Now();
  bus::PublishChunks(others_, channel::kFleetRoster, another);
  executor_.Deliver();
  EXPECT_TRUE(mirror_.FlightSoFar().empty());
}

TEST_F(BusMirrorTest, SendsStatusTwiceASecondAndAtOnceWhenALinkChanges) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(1));
  SendLinks(link_status_t::LINK_UP);
  executor_.RunFor(bus::kSecond / 10);
  Forget();
  executor_.RunFor(bus::kSecond);
  EXPECT_EQ(Count(kStatusKind), 2);
  executor_.RunFor(bus::kSecond / 10);
  Forget();
  SendLinks(link_status_t::LINK_UP);
  executor_.RunFor(0);
  EXPECT_EQ(Count(kStatusKind), 0);
  SendLinks(link_status_t::LINK_LOST);
  executor_.RunFor(0);
  EXPECT_EQ(Count(kStatusKind), 1);
}

TEST_F(BusMirrorTest, TellsAFormationWhenItChanges) {
  SendFormation();
  executor_.RunFor(bus::kSecond);
  SendFormation();
  EXPECT_EQ(Texts("formation").size(), 1u);
  formation_t held = Formation();
  held.hold = true;
  others_.Publish(channel::kFormation, held);
  executor_.Deliver();
  ASSERT_EQ(Texts("formation").size(), 2u);
  EXPECT_EQ(Texts("formation")[1]["hold"], true);
}

TEST_F(BusMirrorTest, ForgetsAFormationThatALivingControllerNoLongerRepeats) {
  bus::StartHeartbeat(others_);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(1));
  SendFormation();
  SendStatus(0);
  EXPECT_EQ(mirror_.Vehicles()["vehicles"][0]["formation_id"], 1);
  executor_.RunFor(2 * bus::kSecond);
  EXPECT_TRUE(Texts("formation_removed").empty());
  executor_.RunFor(2 * bus::kSecond);
  ASSERT_EQ(Texts("formation_removed").size(), 1u);
  EXPECT_EQ(Texts("formation_removed")[0]["formation_id"], 1);
  EXPECT_TRUE(mirror_.State()["formations"].empty());
  EXPECT_TRUE(mirror_.State()["statuses"].empty());
  EXPECT_EQ(mirror_.Vehicles()["vehicles"][0]["formation_id"], 0);
  SendFormation();
  EXPECT_EQ(mirror_.State()["formations"].size(), 1u);
}

TEST_F(BusMirrorTest, KeepsFormationsWhileTheControllerIsSilent) {
  SendFormation();
  executor_.RunFor(60 * bus::kSecond);
  EXPECT_TRUE(Texts("formation_removed").empty());
  EXPECT_EQ(mirror_.State()["formations"].size(), 1u);
}

TEST_F(BusMirrorTest, NamesNodesThatWereHeardAndAreSilent) {
  heartbeat_t heartbeat{};
  heartbeat.heartbeat_node = "collision-monitor";
  others_.Publish(channel::kHeartbeat, heartbeat);
  executor_.Deliver();
  EXPECT_EQ(Texts("heartbeat").size(), 1u);
  executor_.RunFor(bus::ToUtime(2.9));
  EXPECT_TRUE(Texts("bus").empty());
  executor_.RunFor(bus::ToUtime(0.4));
  ASSERT_EQ(Texts("bus").size(), 1u);
  EXPECT_EQ(Texts("bus")[0]["nodes_silent"], Json({"collision-monitor"}));
  others_.Publish(channel::kHeartbeat, heartbeat);
  executor_.RunFor(bus::ToUtime(0.3));
  ASSERT_EQ(Texts("bus").size(), 2u);
  EXPECT_TRUE(Texts("bus")[1]["nodes_silent"].empty());
}

TEST_F(BusMirrorTest, DrawsAPathAnewForANewRevisionAndWhenAnEndlessOneIsFlown) {
  path_t path = bus::ToMessage(Path::Straight({0, 0}, 0, 1000, 50));
  path.utime = Now();
  path.formation_id = 1;
  path.path_revision = 1;
  SendStatus(1000);
  others_.Publish(channel::kPath, path);
  others_.Publish(channel::kPath, path);
  executor_.Deliver();
  ASSERT_EQ(Texts("path").size(), 1u);
  const Json line = Texts("path")[0]["line"];
  EXPECT_EQ(line.front(), Json({-2000., 0., 1000.}));
  EXPECT_GE(line.back()[0].get<double>(), 21'000);
  SendStatus(10'900);
  EXPECT_EQ(Texts("path").size(), 1u);
  SendStatus(11'100);
  ASSERT_EQ(Texts("path").size(), 2u);
  EXPECT_GE(Texts("path")[1]["line"].back()[0].get<double>(), 31'100);
  path.path_revision = 2;
  others_.Publish(channel::kPath, path);
  executor_.Deliver();
  EXPECT_EQ(Texts("path").size(), 3u);
}

TEST_F(BusMirrorTest, KeepsNoMoreInventedNodesAndFormationsThanAFleetCouldHave) {
  heartbeat_t heartbeat{};
  for (int i = 0; i < 150; ++i) {
    heartbeat.heartbeat_node = "invented-" + std::to_string(i);
    others_.Publish(channel::kHeartbeat, heartbeat);
  }
  formation_t formation = Formation();
  for (int i = 1; i <= 10'100; ++i) {
    formation.formation_id = i;
    others_.Publish(channel::kFormation, formation);
    if (i % 100 == 0) executor_.Deliver();
  }
  EXPECT_EQ(Texts("heartbeat").size(), 100u);
  EXPECT_EQ(mirror_.State()["formations"].size(), 10'000u);
  // Those that are known go on.
  formation.formation_id = 1;
  formation.hold = true;
  others_.Publish(channel::kFormation, formation);
  executor_.Deliver();
  EXPECT_EQ(Texts("formation").size(), 10'001u);
}

TEST_F(BusMirrorTest, KeepsTheLastTwoHundredEvents) {
  for (int i = 1; i <= 205; ++i) SendEvent("event " + std::to_string(i));
  executor_.Deliver();
  EXPECT_EQ(Texts("event").size(), 205u);
  const Json kept = mirror_.State()["events"];
  ASSERT_EQ(kept.size(), 200u);
  EXPECT_EQ(kept.front()["text"], "event 6");
  EXPECT_EQ(kept.back()["text"], "event 205");
}

TEST_F(BusMirrorTest, GivesANewcomerHelloFirstAndTheLastOfEach) {
  bus::StartHeartbeat(others_);
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(2));
  SendFormation();
  SendStatus(0);
  path_t path = bus::ToMessage(Path::Straight({0, 0}, 0, 1000, 50));
  path.formation_id = 1;
  others_.Publish(channel::kPath, path);
  SendEvent("something");
  executor_.RunFor(bus::kSecond);
  std::vector<std::string> types;
  for (const LiveFrame& packed : mirror_.Snapshot()) {
    const LiveFrame frame = Unpacked(packed);
    types.push_back(frame.binary ? frame.bytes->front() == kMotionKind ? "MOTION" : "STATUS"
                                 : Json::parse(*frame.bytes)["type"].get<std::string>());
  }
  EXPECT_EQ(types, (std::vector<std::string>{"hello", "bus", "roster", "formation", "path", "statuses",
                                             "heartbeat", "event", "MOTION", "STATUS", "complete"}));
}

TEST_F(BusMirrorTest, ShowsNullForWhatIsNotKnownOfAVehicle) {
  bus::PublishChunks(others_, channel::kFleetRoster, Roster(1));
  executor_.Deliver();
  const Json row = mirror_.Vehicles()["vehicles"][0];
  EXPECT_EQ(row["id"], 1);
  EXPECT_EQ(row["callsign"], "UAV1");
  EXPECT_TRUE(row["east_m"].is_null());
  EXPECT_TRUE(row["downlink"].is_null());
  SendState(1);
  SendLinks(link_status_t::LINK_LATE);
  const Json known = mirror_.Vehicles()["vehicles"][0];
  EXPECT_EQ(known["east_m"], 100.);
  EXPECT_EQ(known["downlink"], "late");
}

TEST_F(BusMirrorTest, AlarmsAreTakenOnAndTheirRepetitionIsNot) {
  const auto send = [&](std::int64_t sequence, std::int8_t state) {
    alarm_list_t list;
    list.utime = Now();
    list.session_id = 5;
    list.sequence = sequence;
    list.alarms.emplace_back();
    list.alarms[0].id = 1;
    list.alarms[0].condition = "link:3";
    list.alarms[0].severity = event_t::WARNING;
    list.alarms[0].state = state;
    bus::PublishChunks(others_, channel::kAlarms, list);
    executor_.RunFor(bus::kSecond);
  };
  send(0, alarm_t::UNACKNOWLEDGED);
  send(1, alarm_t::UNACKNOWLEDGED);
  EXPECT_EQ(Texts("alarms").size(), 1U);
  send(2, alarm_t::ACKNOWLEDGED);
  ASSERT_EQ(Texts("alarms").size(), 2U);
  EXPECT_EQ(Texts("alarms")[1]["alarms"][0]["state"], alarm_t::ACKNOWLEDGED);
  EXPECT_EQ(mirror_.State()["alarms"]["session_id"], 5);
}

}  // namespace
}  // namespace skein::bridge

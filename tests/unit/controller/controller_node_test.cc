#include "controller/controller_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <skein/ack_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "controller/formation_message.h"
#include "core/frames.h"
#include "unit/controller/flight_bench.h"

namespace skein::controller {
namespace {

using std::numbers::pi;

/// A controller on a bus, and a fleet that the test plays: UAV1 to UAV3 in their slots, UAV9 in no formation.
class ControllerNodeTest : public testing::Test {
 protected:
  ControllerNodeTest() {
    config::Scenario scenario;
    config::FormationConfig formation;
    formation.id = 1;
    formation.name = "Triangle";
    formation.shape = Shape::kTriangle;
    formation.spacing_m = 500;
    formation.leader = {0, 0, 1000, 50, pi / 2};
    const auto offsets = ShapeSlots(Shape::kTriangle, 3, 500);
    for (int id = 1; id <= 3; ++id)
      formation.slots.push_back({id, offsets[static_cast<std::size_t>(id - 1)]});
    scenario.formations.push_back(formation);
    for (const Slot& slot : formation.slots) {
      uavs_[slot.vehicle_id] = {-slot.offset.left_m, slot.offset.forward_m, 1000, 50, pi / 2, 0};
    }
    uavs_[9] = {20000, 0, 500, 45, 0, 0};
    options_.scenario = scenario;
    station_.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [this](const fleet_command_t& command) {
      ++command_messages_;
      for (const auto& one : command.commands) commands_[one.id] = one;
      last_ = command;
    });
    station_.Subscribe<ack_t>(bus::channel::kAck, [this](const ack_t& ack) { ack_ = ack; });
    station_.Subscribe<event_t>(bus::channel::kEvent,
                                [this](const event_t& event) { codes_.push_back(event.code); });
    station_.Subscribe<formation_t>(bus::channel::kFormation,
                                    [this](const formation_t& formation) { formation_ = formation; });
    station_.Subscribe<formation_status_t>(bus::channel::kFormationStatus,
                                           [this](const formation_status_t& status) { status_ = status; });
  }

  void Start() { node_ = std::make_unique<FormationControllerNode>(bus_, options_); }

  void SendRoster(const std::string& scenario = "") {
    fleet_roster_t roster{};
    roster.utime = executor_.Now();
    roster.session_id = 1;
    roster.start_utime = start_utime_;
    roster.scenario = scenario;
    for (const auto& [id, uav] : uavs_) {
      roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel(), true));
    }
    roster.revision = 1;
    bus::PublishChunks(station_, bus::channel::kFleetRoster, roster);
    executor_.Deliver();
  }

  void Fly(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      fleet_state_t state{};
      state.utime = executor_.Now() + clock_error_;
      state.session_id = 1;
      state.tick = tick_++;
      for (const auto& [id, uav] : uavs_) {
        if (id == silent_) continue;
        vehicle_state_t vehicle = bus::ToMessage(uav);
        vehicle.utime = state.utime;
        vehicle.id = id;
        vehicle.command_session_id = 0;
        vehicle.command_sequence = 0;
        vehicle.payload_on = 0;
        state.vehicles.push_back(vehicle);
      }
      bus::PublishChunks(station_, bus::channel::kFleetState, state);
      executor_.Deliver();
      for (auto& [id, uav] : uavs_) {
        const auto command = commands_.find(id);
        AutopilotInput input{uav.speed_m_s, uav.course_rad, 0};
        if (command != commands_.end()) {
          input = {command->second.speed_input_m_s, command->second.course_input_rad,
                   command->second.climb_input_rad};
        }
        uav = Step(uav, input, VehicleModel(), 0.05);
      }
      executor_.RunFor(FlightBench::kTick);
    }
  }

  formation_command_t Command(std::int8_t action) {
    formation_command_t command{};
    command.utime = executor_.Now();
    command.session_id = 77;
    command.request_id = ++request_id_;
    command.to_session_id = bus_.session_id();
    command.action = action;
    command.formation = formation_;
    return command;
  }

  ack_t Ask(const formation_command_t& command) {
    ack_ = {};
    station_.Publish(bus::channel::kCmdFormation, command);
    executor_.Deliver();
    return ack_;
  }

  bus::Transport transport_ = bus::MakeTransport("memq://");
  bus::SimulatedExecutor executor_{transport_.lcm};
  bus::Bus bus_{transport_.lcm, "formation-controller", executor_};
  bus::Bus station_{transport_.lcm, "test", executor_};
  ControllerOptions options_;
  std::unique_ptr<FormationControllerNode> node_;
  std::map<int, VehicleState> uavs_;
  bus::Utime start_utime_ = bus::SimulatedExecutor::kStart;
  std::int64_t tick_ = 0;
  bus::Utime clock_error_ = 0;
  int silent_ = 0;
  std::int64_t request_id_ = 0;
  int command_messages_ = 0;
  std::map<int, vehicle_command_t> commands_;
  fleet_command_t last_;
  ack_t ack_;
  formation_t formation_;
  formation_status_t status_;
  std::vector<std::string> codes_;
};

TEST_F(ControllerNodeTest, AnswersEachTickAtOnceForEveryUav) {
  Start();
  Fly(1);
  EXPECT_EQ(command_messages_, 0) << "who they are is not known yet";
  SendRoster();
  Fly(20);
  EXPECT_EQ(command_messages_, 20);
  EXPECT_EQ(commands_.size(), 4u);
  EXPECT_EQ(last_.state_tick, 20);
  EXPECT_EQ(last_.request_id, 20);
  EXPECT_EQ(last_.session_id, bus_.session_id());
}

TEST_F(ControllerNodeTest, HoldsTheUavsThatAreInNoFormation) {
  Start();
  SendRoster();
  Fly(400);
  EXPECT_NEAR(uavs_.at(9).up_m, 500, 0.1);
  EXPECT_NEAR(uavs_.at(9).speed_m_s, 45, 0.01);
  EXPECT_NEAR(uavs_.at(9).course_rad, 0, 1e-6);
}

TEST_F(ControllerNodeTest, RepeatsFormationPathAndStatusForThoseWhoJoinLate) {
  Start();
  SendRoster();
  Fly(45);
  EXPECT_EQ(formation_.formation_id, 1);
  EXPECT_EQ(formation_.num_slots, 3);
  EXPECT_EQ(status_.num_slots, 3);
  EXPECT_EQ(status_.mode, formation_status_t::MODE_IN_FORMATION);
}

TEST(FormationStatuses, ComeLessOftenTheMoreFormationsThereAreButEachSecond) {
  EXPECT_EQ(StatusEveryTicks(0), 4);
  EXPECT_EQ(StatusEveryTicks(20), 4);
  EXPECT_EQ(StatusEveryTicks(21), 5);
  EXPECT_EQ(StatusEveryTicks(100), 20);
  EXPECT_EQ(StatusEveryTicks(500), 20);
}

TEST_F(ControllerNodeTest, HoldsResumesAndRemovesAFormation) {
  Start();
  SendRoster();
  Fly(30);
  EXPECT_TRUE(Ask(Command(formation_command_t::ACTION_HOLD)).accepted);
  EXPECT_TRUE(formation_.hold);
  Fly(30);
  EXPECT_EQ(status_.mode, formation_status_t::MODE_HOLDING);
  EXPECT_TRUE(Ask(Command(formation_command_t::ACTION_RESUME)).accepted);
  EXPECT_FALSE(formation_.hold);
  EXPECT_TRUE(Ask(Command(formation_command_t::ACTION_REMOVE)).accepted);
  EXPECT_EQ(formation_.num_slots, 0) << "it says that it is gone";
  const VehicleState before = uavs_.at(1);
  Fly(200);
  EXPECT_NEAR(uavs_.at(1).course_rad, before.course_rad, 0.01) << "its UAVs hold";
  EXPECT_FALSE(Ask(Command(formation_command_t::ACTION_HOLD)).accepted);
}

TEST_F(ControllerNodeTest, RefusesFormationsThatCannotBe) {
  Start();
  EXPECT_NE(Ask(Command(formation_command_t::ACTION_HOLD)).reason.find("no fleet"), std::string::npos);
  SendRoster();
  Fly(30);
  const auto refused = [&](auto change) {
    formation_command_t command = Command(formation_command_t::ACTION_APPLY);
    change(command.formation);
    const ack_t ack = Ask(command);
    EXPECT_FALSE(ack.accepted);
    return ack.reason;
  };
  EXPECT_NE(refused([](formation_t& f) { f.slots[0].vehicle_id = 5; }).find("no UAV 5"), std::string::npos);
  EXPECT_NE(refused([](formation_t& f) { f.slots[0].vehicle_id = 2; }).find("two slots"), std::string::npos);
  EXPECT_NE(refused([](formation_t& f) { f.control = "best"; }).find("best"), std::string::npos);
  EXPECT_NE(refused([](formation_t& f) { f.d_mod_m = 10; }).find("d_mod_m"), std::string::npos);
  EXPECT_NE(refused([](formation_t& f) { f.formation_id = 2; }).find("flies in formation 1"),
            std::string::npos);
  EXPECT_NE(refused([](formation_t& f) { f.slots.clear(), f.num_slots = 0; }).find("slot"),
            std::string::npos);
  for (const int id : {0, -1, std::numeric_limits<int>::min()}) {
    const std::string why_not = refused([id](formation_t& f) {
      f.formation_id = id;
      f.slots = {f.slots[0]};
      f.slots[0].vehicle_id = 9;  // in no formation
      f.num_slots = 1;
    });
    EXPECT_NE(why_not.find("id"), std::string::npos) << why_not;
  }
}

TEST_F(ControllerNodeTest, TakesSlotsInsideOneAnothersCylinderButSaysSo) {
  Start();
  SendRoster();
  Fly(30);
  formation_command_t command = Command(formation_command_t::ACTION_APPLY);
  EXPECT_EQ(Ask(command).reason, "");
  command = Command(formation_command_t::ACTION_APPLY);
  command.formation.slots[2] = command.formation.slots[1];
  command.formation.slots[2].vehicle_id = 3;
  command.formation.slots[2].left_m -= 100;
  command.formation.slots[2].up_m += 30;
  const ack_t ack = Ask(command);
  EXPECT_TRUE(ack.accepted);
  EXPECT_EQ(ack.reason,
            "the slots of UAV2 and UAV3 are 100 m apart and 30 m in height: inside one another's cylinder");
  EXPECT_EQ(codes_.back(), "formation_applied");
}

TEST_F(ControllerNodeTest, GoesOnFromAStateThatItIsGiven) {
  Start();
  SendRoster();
  Fly(40);
  const FormationFlight& flight = node_->flights().at(1);
  ControllerState state{start_utime_, {}};
  state.formations.push_back({FormationMessage(flight, executor_.Now()), PathMessage(flight, executor_.Now()),
                              flight.Status(tick_), std::nullopt, 0});
  const double arc = flight.leader().arc_m();
  const auto before = std::move(node_);  // its bus still calls it
  options_.scenario->formations.clear();
  options_.state = state;
  Start();
  SendRoster();
  ASSERT_TRUE(node_->flights().contains(1));
  EXPECT_EQ(node_->flights().at(1).leader().arc_m(), arc);
}

TEST_F(ControllerNodeTest, StartsANewFormationWhereItsUavsFly) {
  Start();
  SendRoster();
  Fly(30);
  formation_command_t command = Command(formation_command_t::ACTION_APPLY);
  command.formation.formation_id = 2;
  bus::SetSlots(command.formation, {{9, {-1000, 0, 0}}});
  command.formation.shape = "custom";
  const ack_t ack = Ask(command);
  EXPECT_TRUE(ack.accepted) << ack.reason;
  Fly(100);
  EXPECT_NEAR(uavs_.at(9).up_m, 500, 1) << "it goes on as it flew";
  EXPECT_NEAR(uavs_.at(9).course_rad, 0, 0.01);
  EXPECT_EQ(node_->flights().size(), 2u);
}

TEST_F(ControllerNodeTest, MovesNoLeaderForOneTickWithAFalseTime) {
  Start();
  SendRoster();
  Fly(30);
  const double before_m = node_->flights().at(1).leader().arc_m();
  clock_error_ = 8 * bus::kSecond;  // a greater one the chunks' order does not let through
  Fly(1);
  clock_error_ = 0;
  Fly(20);
  const double flown_m = node_->flights().at(1).leader().arc_m() - before_m;
  EXPECT_GT(flown_m, 20);
  EXPECT_LT(flown_m, 21 * 0.05 * 100);
}

TEST_F(ControllerNodeTest, GoesOnCommandingWhenTheFleetsClockIsSetBack) {
  Start();
  SendRoster();
  Fly(30);
  clock_error_ = -60 * bus::kSecond;
  Fly(10);  // the third rising stamp is taken
  const int before = command_messages_;
  Fly(20);
  EXPECT_EQ(command_messages_, before + 20);
  EXPECT_EQ(commands_.size(), 4u);
}

TEST_F(ControllerNodeTest, KeepsASilentUavThatIsInNoFormationLevel) {
  Start();
  SendRoster();
  Fly(30);
  uavs_.at(9).up_m -= 30;  // below what it holds, when it is heard last
  Fly(1);
  silent_ = 9;
  link_status_t links{};
  links.utime = executor_.Now();
  vehicle_link_t link{};
  link.id = 9;
  link.downlink = link_status_t::LINK_LOST;
  links.links.push_back(link);
  bus::PublishChunks(station_, bus::channel::kLinkStatus, links);
  executor_.Deliver();
  commands_.clear();
  Fly(5);
  ASSERT_TRUE(commands_.contains(9)) << "or its uplink could not be judged";
  EXPECT_NEAR(commands_.at(9).climb_input_rad, 0, 1e-9);
}

TEST_F(ControllerNodeTest, GoesOnWhereAKilledControllerWas) {
  options_.state_file =
      std::filesystem::temp_directory_path() / ("skein_state_" + std::to_string(::getpid()));
  Start();
  SendRoster();
  Fly(30);
  path_command_t path{};
  path.utime = executor_.Now();
  path.session_id = 77;
  path.request_id = ++request_id_;
  path.to_session_id = bus_.session_id();
  path.formation_id = 1;
  for (const Waypoint& waypoint : std::vector<Waypoint>{{0, 6000, 1000, 50}, {9000, 9000, 1000, 50}}) {
    path.waypoints.push_back(bus::ToMessage(waypoint));
  }
  path.num_waypoints = 2;
  station_.Publish(bus::channel::kCmdPath, path);
  executor_.Deliver();
  ASSERT_TRUE(ack_.accepted) << ack_.reason;
  Fly(30);
  ASSERT_TRUE(Ask(Command(formation_command_t::ACTION_HOLD)).accepted);
  Fly(30);
  const double arc = node_->flights().at(1).leader().arc_m();
  const double east_m = node_->flights().at(1).leader().path().At(arc).position.x();
  node_.reset();

  // Another process with nothing but the file.
  bus::Transport transport = bus::MakeTransport("memq://");
  bus::SimulatedExecutor executor(transport.lcm, executor_.Now());
  bus::Bus other(transport.lcm, "formation-controller", executor);
  bus::Bus station(transport.lcm, "test", executor);
  FormationControllerNode restarted(other, options_);
  fleet_state_t state{};
  state.utime = executor.Now();
  state.session_id = 1;
  state.tick = tick_;
  state.chunk_count = 1;
  bus::PublishChunks(station, bus::channel::kFleetState, state);
  executor.RunFor(2 * bus::kSecond);  // the roster comes late; the file must not be overwritten until then
  fleet_roster_t roster{};
  roster.utime = executor.Now();
  roster.session_id = 1;
  roster.start_utime = start_utime_;
  for (const auto& [id, uav] : uavs_) {
    roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel(), true));
  }
  bus::PublishChunks(station, bus::channel::kFleetRoster, roster);
  executor.Deliver();
  ASSERT_EQ(restarted.flights().size(), 1u);
  const FormationFlight& flight = restarted.flights().at(1);
  EXPECT_EQ(flight.waypoints().size(), 2u);
  EXPECT_TRUE(flight.holding()) << "and Resume knows the path";
  EXPECT_NEAR(flight.leader().arc_m(), arc, 60) << "as of the last second";
  EXPECT_NEAR(flight.leader().path().At(arc).position.x(), east_m, 1e-6);

  roster.start_utime += 1;  // another flight: the file is of no use
  roster.session_id = 2;
  bus::PublishChunks(station, bus::channel::kFleetRoster, roster);
  executor.Deliver();
  EXPECT_EQ(restarted.flights().at(1).waypoints().size(), 2u) << "a roster by itself ends no flight";
  state.utime = executor.Now();
  state.session_id = 2;
  bus::PublishChunks(station, bus::channel::kFleetState, state);
  executor.Deliver();
  EXPECT_TRUE(restarted.flights().at(1).waypoints().empty());
  std::filesystem::remove(options_.state_file);
}

/// A controller that was killed, and another process that goes on with nothing but its file.
class KilledControllerTest : public ControllerNodeTest {
 protected:
  KilledControllerTest() {
    options_.state_file =
        std::filesystem::temp_directory_path() / ("skein_killed_" + std::to_string(::getpid()));
    Start();
    SendRoster();
    Fly(20);
    silent_ = 3;
  }
  ~KilledControllerTest() override { std::filesystem::remove(options_.state_file); }

  static void TellLost(bus::Bus& from, int id) {
    link_status_t links{};
    links.utime = from.executor().Now();
    links.chunk_count = 1;
    vehicle_link_t link{};
    link.id = id;
    link.downlink = link_status_t::LINK_LOST;
    links.links.push_back(link);
    links.num_links = 1;
    from.Publish(bus::channel::kLinkStatus, links);
  }

  /// What the other one tells at its first ticks; UAV3 stays silent.
  std::vector<formation_status_t> GoOn(bus::Utime after, bool tell_lost) {
    node_.reset();
    bus::Transport transport = bus::MakeTransport("memq://");
    bus::SimulatedExecutor executor(transport.lcm, executor_.Now() + after);
    bus::Bus other(transport.lcm, "formation-controller", executor);
    bus::Bus station(transport.lcm, "test", executor);
    std::vector<formation_status_t> told;
    station.Subscribe<formation_status_t>(bus::channel::kFormationStatus,
                                          [&](const formation_status_t& status) { told.push_back(status); });
    options_.status_every_ticks = 1;
    const FormationControllerNode restarted(other, options_);
    fleet_roster_t roster{};
    roster.utime = executor.Now();
    roster.session_id = 1;
    roster.start_utime = start_utime_;
    for (const auto& [id, uav] : uavs_)
      roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel(), true));
    bus::PublishChunks(station, bus::channel::kFleetRoster, roster);
    if (tell_lost) TellLost(station, 3);
    for (int i = 0; i < 3; ++i) {
      fleet_state_t state{};
      state.utime = executor.Now();
      state.session_id = 1;
      state.tick = tick_ + after / FlightBench::kTick + i;
      for (const auto& [id, uav] : uavs_) {
        if (id == silent_) continue;
        vehicle_state_t vehicle = bus::ToMessage(uav);
        vehicle.utime = state.utime;
        vehicle.id = id;
        vehicle.command_session_id = vehicle.command_sequence = 0;
        vehicle.payload_on = 0;
        state.vehicles.push_back(vehicle);
      }
      bus::PublishChunks(station, bus::channel::kFleetState, state);
      executor.RunFor(FlightBench::kTick);
    }
    return told;
  }
};

TEST_F(KilledControllerTest, GoesOnWithTheClimbThatItWasIn) {
  Fly(80);
  TellLost(station_, 3);
  Fly(130);  // to half a second after the state was kept
  ASSERT_EQ(status_.mode, formation_status_t::MODE_AVOIDING);
  ASSERT_EQ(status_.avoidance_rate_m_s, 10);
  const formation_status_t before = node_->flights().at(1).Status(tick_);
  constexpr bus::Utime kGap = bus::kSecond / 2;
  const auto told = GoOn(kGap, false);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().mode, formation_status_t::MODE_AVOIDING) << told.front().mode_text;
  EXPECT_EQ(told.front().mode_utime, before.mode_utime);
  EXPECT_EQ(told.front().avoidance_target_m, before.avoidance_target_m);
  EXPECT_NEAR(told.front().avoidance_up_m,
              before.avoidance_up_m + 10 * bus::ToSeconds(told.front().utime - before.utime), 1e-6);
}

TEST_F(KilledControllerTest, AvoidsAUavThatHasBeenSilentSinceBefore) {
  Fly(60);
  ASSERT_EQ(status_.avoidance_target_m, 0) << "nobody has called it lost yet";
  const auto told = GoOn(bus::kSecond / 2, true);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().mode, formation_status_t::MODE_AVOIDING) << told.back().mode_text;
  EXPECT_EQ(told.back().avoidance_target_m, 200);
}

TEST_F(ControllerNodeTest, DoesNotCatchUpWithAStartThatNoFlightCanHave) {
  start_utime_ = 1;  // 1970: seven thousand million steps
  Start();
  SendRoster();
  Fly(3);
  EXPECT_LT(node_->flights().at(1).leader().arc_m(), 50);
}

TEST_F(ControllerNodeTest, SaysWhatReceiversTakeHoweverLongNamesAre) {
  Start();
  fleet_roster_t roster{};
  roster.utime = executor_.Now();
  roster.session_id = 1;
  roster.start_utime = start_utime_;
  for (const auto& [id, uav] : uavs_)
    roster.vehicles.push_back(bus::ToMessage(id, std::string(4000, 'x'), VehicleModel(), true));
  bus::PublishChunks(station_, bus::channel::kFleetRoster, roster);
  Fly(3);
  link_status_t links{};
  links.utime = executor_.Now();
  links.sequence = 1;
  for (const int id : {1, 2}) {
    vehicle_link_t link{};
    link.id = id;
    link.downlink = link_status_t::LINK_LOST;
    links.links.push_back(link);
  }
  bus::PublishChunks(station_, bus::channel::kLinkStatus, links);
  Fly(10);
  EXPECT_EQ(status_.mode, formation_status_t::MODE_AVOIDING);
  EXPECT_LT(status_.mode_text.size(), 500u);
}

TEST_F(ControllerNodeTest, TakesTheScenarioThatANewFlightNames) {
  config::Scenario other = *options_.scenario;
  other.name = "Other";
  other.formations[0].name = "Other triangle";
  options_.find_scenario = [&](const std::string& name) {
    return name == "Other" ? std::optional(other) : std::nullopt;
  };
  Start();
  SendRoster("Unknown");
  EXPECT_EQ(node_->flights().at(1).config().name, "Triangle") << "at the start it is the operator's choice";
  Fly(3);
  start_utime_ = executor_.Now();
  SendRoster("Other");
  EXPECT_EQ(node_->flights().at(1).config().name, "Other triangle");
  Fly(3);
  start_utime_ = executor_.Now();
  SendRoster("Unknown");
  EXPECT_TRUE(node_->flights().empty());
  EXPECT_EQ(codes_.back(), "scenario_missing");
}

}  // namespace
}  // namespace skein::controller

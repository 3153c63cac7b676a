#include <limits>

#include "controller/formation_message.h"
#include "core/frames.h"
#include "unit/controller/controller_fixture.h"

namespace skein::controller {
namespace {

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

// Messages that decode but lie, said to whole nodes: each is refused or flagged, counted in HEARTBEAT and
// told once in EVENT, and the flight goes on as one without it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <skein/formation_command_t.hpp>
#include <skein/link_command_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/payload_command_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bus/channels.h"
#include "unit/lies/whole_nodes.h"

namespace skein::testing {
namespace {

namespace channel = bus::channel;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr bus::Utime kDay = 86'400 * bus::kSecond;
constexpr int kUnheardOf = 4711;

const std::set<std::string> kWhoHearsTheFleet{"formation-controller", "collision-monitor", "web-bridge"};
const std::set<std::string> kWhoHearsCommands{"fleet-simulator", "collision-monitor"};
const std::set<std::string> kWhoHearsFormations{"collision-monitor", "web-bridge"};
const std::set<std::string> kWhoHearsLinks{"formation-controller", "web-bridge"};
const std::set<std::string> kBridge{"web-bridge"};
const std::set<std::string> kSimulator{"fleet-simulator"};
const std::set<std::string> kController{"formation-controller"};
const std::set<std::string> kMonitor{"collision-monitor"};

struct Lie {
  std::string name;
  std::set<std::string> nodes;  ///< that must refuse or flag it
  std::string code;             ///< of the event by which each of them tells it
  std::function<void(WholeNodes&)> tell;
};

/// The next state of the fleet, a little early and not quite true.
template <typename Change>
Lie State(std::string name, Change change, std::set<std::string> nodes = kWhoHearsTheFleet,
          std::string code = "message_refused") {
  return {"State" + name, std::move(nodes), std::move(code), [change](WholeNodes& nodes_of) {
            fleet_state_t state = nodes_of.state;
            ++state.tick;
            state.utime += 10'000;
            for (vehicle_state_t& uav : state.vehicles) uav.utime += 10'000;
            change(state);
            nodes_of.SayAll(channel::kFleetState, state);
          }};
}
template <typename Change>
Lie Roster(std::string name, Change change) {
  return {"Roster" + name, kWhoHearsTheFleet, "message_refused", [change](WholeNodes& nodes) {
            fleet_roster_t roster = nodes.roster;
            roster.utime = nodes.Now();
            change(roster);
            nodes.SayAll(channel::kFleetRoster, roster);
          }};
}
template <typename Change>
Lie Command(std::string name, Change change, std::set<std::string> nodes = kSimulator) {
  return {"Command" + name, std::move(nodes), "message_refused", [change](WholeNodes& nodes_of) {
            fleet_command_t command = nodes_of.command;
            change(command, nodes_of);
            nodes_of.Say(channel::kCmdFleet, command);
          }};
}
/// Something that was said before, changed.
template <typename Message, typename Change>
Lie Said(std::string name, const char* channel, Message WholeNodes::*said, std::set<std::string> nodes,
         Change change) {
  return {std::move(name), std::move(nodes), "message_refused", [=](WholeNodes& nodes_of) {
            Message message = nodes_of.*said;
            message.utime = nodes_of.Now();
            change(message);
            nodes_of.Say(channel, message);
          }};
}
/// An operator's command.
template <typename Message, typename Change>
Lie Asked(std::string name, const char* channel, std::set<std::string> nodes, Change change) {
  return {std::move(name), std::move(nodes), "message_refused", [=](WholeNodes& nodes_of) {
            Message message{};
            message.utime = nodes_of.Now();
            message.session_id = message.request_id = 1;
            change(message, nodes_of);
            nodes_of.Say(channel, message);
          }};
}

std::vector<Lie> Lies() {
  return {
      State("NaN", [](fleet_state_t& state) { state.vehicles[1].east_m = kNaN; }),
      State("Infinite", [](fleet_state_t& state) { state.vehicles[1].speed_m_s = kInfinity; }),
      State("OutOfRange", [](fleet_state_t& state) { state.vehicles[1].up_m = 1e12; }),
      State("NobodysId", [](fleet_state_t& state) { state.vehicles[1].id = 0; }),
      State("DuplicateId", [](fleet_state_t& state) { state.vehicles[1].id = state.vehicles[0].id; }),
      State("DuplicateIdInTwoChunks",
            [](fleet_state_t& state) {
              for (int id = 1; id <= 200; ++id) {
                state.vehicles.push_back(state.vehicles[0]);
                state.vehicles.back().id = 1000 + id % 150;
              }
            }),
      State("ADayAhead", [](fleet_state_t& state) { state.utime += kDay; }),
      State("ADayBack", [](fleet_state_t& state) { state.utime -= kDay; }),
      State("OfAnEarlierSession",
            [](fleet_state_t& state) {
              state.session_id -= kDay;
              state.utime -= kDay;
            }),
      State(
          "OfAUavADayAhead", [](fleet_state_t& state) { state.vehicles[1].utime += kDay; }, kMonitor,
          "time_jumped"),
      State(
          "OfAUavADayBack", [](fleet_state_t& state) { state.vehicles[1].utime -= kDay; }, kMonitor,
          "time_jumped"),
      State(
          "Teleport", [](fleet_state_t& state) { state.vehicles[1].north_m += 50'000; }, kMonitor,
          "position_leapt"),

      Roster("NaN", [](fleet_roster_t& roster) { roster.origin_altitude_m = kNaN; }),
      Roster("Infinite", [](fleet_roster_t& roster) { roster.vehicles[1].max_speed_m_s = kInfinity; }),
      Roster("OutOfRange", [](fleet_roster_t& roster) { roster.origin_latitude_deg = 91; }),
      Roster("NobodysId", [](fleet_roster_t& roster) { roster.vehicles[1].id = -1; }),
      Roster("DuplicateId", [](fleet_roster_t& roster) { roster.vehicles[1].id = roster.vehicles[0].id; }),
      Roster("ADayAhead", [](fleet_roster_t& roster) { roster.utime += kDay; }),
      Roster("ADayBack", [](fleet_roster_t& roster) { roster.utime -= kDay; }),

      Command(
          "NaN", [](fleet_command_t& command, auto&) { command.commands[1].climb_input_rad = kNaN; },
          kWhoHearsCommands),
      Command(
          "Infinite",
          [](fleet_command_t& command, auto&) { command.commands[1].speed_input_m_s = -kInfinity; },
          kWhoHearsCommands),
      Command(
          "OutOfRange", [](fleet_command_t& command, auto&) { command.commands[1].course_input_rad = 1e10; },
          kWhoHearsCommands),
      Command(
          "DuplicateId",
          [](fleet_command_t& command, auto&) { command.commands[1].id = command.commands[0].id; },
          kWhoHearsCommands),
      Command("UnknownId", [](fleet_command_t& command, auto&) { command.commands[1].id = kUnheardOf; }),
      Command("OfAnEarlierController", [](fleet_command_t& command, auto&) { command.session_id -= kDay; }),
      Command("ToAnotherFlight", [](fleet_command_t& command, auto&) { command.to_session_id += kDay; }),
      Command("ADayBack",
              [](fleet_command_t& command, auto&) {
                command.utime -= kDay;
                command.state_tick = command.request_id = 1;
              }),
      Command("ADayAhead",
              [](fleet_command_t& command, auto&) {
                command.utime += kDay;
                command.state_tick += kDay / simulator::FleetSimulatorNode::kPeriod;
                command.request_id += kDay / simulator::FleetSimulatorNode::kPeriod;
                for (vehicle_command_t& one : command.commands) one.speed_input_m_s = 0;
              }),

      Said("FormationNaN", channel::kFormation, &WholeNodes::formation, kWhoHearsFormations,
           [](formation_t& formation) { formation.radius_m = kNaN; }),
      Said("FormationDuplicateId", channel::kFormation, &WholeNodes::formation, kWhoHearsFormations,
           [](formation_t& formation) { formation.slots[1].vehicle_id = formation.slots[0].vehicle_id; }),
      Said("FormationOfNobodysId", channel::kFormation, &WholeNodes::formation, kWhoHearsFormations,
           [](formation_t& formation) { formation.formation_id = 0; }),
      Said("LinkNaN", channel::kLinkStatus, &WholeNodes::links, kWhoHearsLinks,
           [](link_status_t& links) { links.links[1].downlink_age_s = kNaN; }),
      Said("LinkUnknownState", channel::kLinkStatus, &WholeNodes::links, kWhoHearsLinks,
           [](link_status_t& links) { links.links[1].downlink = 9; }),
      Said("LinkDuplicateId", channel::kLinkStatus, &WholeNodes::links, kWhoHearsLinks,
           [](link_status_t& links) {
             links.links[1].id = links.links[0].id;
             links.links[1].downlink = link_status_t::LINK_LOST;
           }),
      Said("LinkADayAhead", channel::kLinkStatus, &WholeNodes::links, kWhoHearsLinks,
           [](link_status_t& links) {
             links.utime += kDay;
             ++links.sequence;
             for (vehicle_link_t& link : links.links) link.downlink = link_status_t::LINK_LOST;
           }),
      Said("StatusInfinite", channel::kFormationStatus, &WholeNodes::status, kBridge,
           [](formation_status_t& status) { status.leader_arc_m = kInfinity; }),
      Said("ProximityNaN", channel::kProximity, &WholeNodes::proximity, kBridge,
           [](proximity_t& proximity) { proximity.vehicles[1].nearest_vertical_m = kNaN; }),
      Said("PathNaN", channel::kPath, &WholeNodes::path, kBridge,
           [](path_t& path) { path.start_arc_m = kNaN; }),
      Said("AlarmsNegative", channel::kAlarms, &WholeNodes::alarms, kBridge,
           [](alarm_list_t& alarms) { alarms.num_warnings = -1; }),

      Asked<formation_command_t>("AskedFormationNaN", channel::kCmdFormation, kController,
                                 [](formation_command_t& command, const WholeNodes& nodes) {
                                   command.formation = nodes.formation;
                                   command.formation.spacing_m = kNaN;
                                 }),
      Asked<path_command_t>("AskedPathInfinite", channel::kCmdPath, kController,
                            [](path_command_t& command, auto&) {
                              command.waypoints.emplace_back().east_m = kInfinity;
                              command.num_waypoints = 1;
                            }),
      Asked<link_command_t>("AskedLinkNaN", channel::kCmdLink, kSimulator,
                            [](link_command_t& command, auto&) {
                              command.vehicle_id = 1;
                              command.downlink = true;
                              command.loss = kNaN;
                            }),
  };
}

/// Where everybody is, what is on, and what is heard: of a flight with lies and of one without.
void ExpectSameFlight(const WholeNodes& lied, const WholeNodes& honest) {
  EXPECT_NEAR(lied.commands, honest.commands, 0.05 * honest.commands);
  ASSERT_EQ(lied.simulator().fleet().size(), honest.simulator().fleet().size());
  for (std::size_t i = 0; i < honest.simulator().fleet().size(); ++i) {
    const VehicleState one = lied.simulator().fleet()[i].state();
    const VehicleState other = honest.simulator().fleet()[i].state();
    EXPECT_LT(std::hypot(one.east_m - other.east_m, one.north_m - other.north_m, one.up_m - other.up_m), 5)
        << "UAV " << i + 1;
    EXPECT_LT(std::abs(one.climb_rad), 0.5);
  }
  EXPECT_EQ(lied.roster.vehicles.size(), honest.roster.vehicles.size());
  EXPECT_TRUE(lied.alarms.alarms.empty()) << lied.alarms.alarms[0].text;
  for (const auto& [node, heartbeat] : lied.heartbeats) EXPECT_EQ(heartbeat.handler_exceptions, 0) << node;
  const bridge::Json shown = lied.mirror().Vehicles()["vehicles"];
  EXPECT_EQ(shown.size(), honest.mirror().Vehicles()["vehicles"].size());
  EXPECT_GT(lied.frames, honest.frames * 9 / 10);
}

class LyingMessages : public ::testing::TestWithParam<Lie> {};

TEST_P(LyingMessages, AreRefusedOrFlaggedCountedAndToldOnceAndChangeNothing) {
  WholeNodes nodes;
  WholeNodes honest;
  for (WholeNodes* flight : {&nodes, &honest}) flight->Run(20);
  const auto before = nodes.Refused();
  for (const auto& [node, refused] : before) ASSERT_EQ(refused, 0) << node;
  ASSERT_EQ(before.size(), 4U);
  nodes.events.clear();
  constexpr int kTimes = 5;
  for (int i = 0; i < kTimes; ++i) {
    // Between two of them comes the truth: what is said more often than it is a source whose clock was set.
    GetParam().tell(nodes);
    for (WholeNodes* flight : {&nodes, &honest}) flight->Run(1.05);
  }
  for (WholeNodes* flight : {&nodes, &honest}) flight->Run(8);

  const auto after = nodes.Refused();
  std::map<std::string, std::multiset<std::string>> told;
  for (const event_t& event : nodes.events) told[event.event_node].insert(event.code);
  for (const std::string& node : GetParam().nodes) {
    EXPECT_GE(after.at(node), kTimes) << node;
    EXPECT_EQ(told[node], std::multiset<std::string>{GetParam().code}) << node;
  }
  // Others have nothing to complain of: neither of the lie nor of what the liars' victims say.
  for (const auto& [node, codes] : told) {
    EXPECT_TRUE(GetParam().nodes.contains(node)) << node << " told " << *codes.begin();
  }
  ExpectSameFlight(nodes, honest);
}

INSTANTIATE_TEST_SUITE_P(Lies, LyingMessages, ::testing::ValuesIn(Lies()),
                         [](const auto& info) { return info.param.name; });

TEST(LyingMessages, OfAMillionUavsAreRefusedToo) {
  WholeNodes nodes;
  WholeNodes honest;
  for (WholeNodes* flight : {&nodes, &honest}) flight->Run(20);
  nodes.events.clear();
  fleet_state_t state = nodes.state;
  ++state.tick;
  state.utime += 10'000;
  const vehicle_state_t uav = state.vehicles[0];
  for (int id = 1000; id < 1'001'000; ++id) {
    state.vehicles.push_back(uav);
    state.vehicles.back().id = id;
  }
  nodes.SayAll(channel::kFleetState, state);
  for (WholeNodes* flight : {&nodes, &honest}) flight->Run(10);
  std::map<std::string, std::multiset<std::string>> told;
  for (const event_t& event : nodes.events) told[event.event_node].insert(event.code);
  for (const std::string& node : kWhoHearsTheFleet) {
    EXPECT_GE(nodes.Refused().at(node), 1) << node;
    EXPECT_EQ(told[node], std::multiset<std::string>{"message_refused"}) << node;
  }
  ExpectSameFlight(nodes, honest);
}

}  // namespace
}  // namespace skein::testing

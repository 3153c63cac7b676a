#include "bridge/command_parser.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "config/scenario.h"

namespace skein::bridge {
namespace {

using nlohmann::json;

template <typename Parse>
std::string Refusal(Parse parse, const char* body) {
  try {
    parse(json::parse(body));
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string LinkRefusal(const char* body) {
  return Refusal([](const json& parsed) { return ParseLinkCommand(parsed, 0); }, body);
}

TEST(LinkCommand, TakesDefaultsForWhatIsMissing) {
  const auto command = ParseLinkCommand(json::parse(R"({"vehicle_id": 3, "mode": "silent"})"), 1000);
  EXPECT_EQ(command.vehicle_id, 3);
  EXPECT_EQ(command.mode, link_command_t::MODE_SILENT);
  EXPECT_TRUE(command.uplink);
  EXPECT_TRUE(command.downlink);
  EXPECT_EQ(command.start_utime, 0);
  EXPECT_EQ(command.duration_s, 0);
  EXPECT_EQ(command.loss, 0);
}

TEST(LinkCommand, RestoresALink) {
  const auto command = ParseLinkCommand(json::parse(R"({"vehicle_id": 3, "mode": "restored"})"), 1000);
  EXPECT_EQ(command.mode, link_command_t::MODE_RESTORED);
}

TEST(LinkCommand, TakesEveryField) {
  const auto command = ParseLinkCommand(json::parse(R"({"vehicle_id": 3, "mode": "frozen", "uplink": false,
      "downlink": true, "delay_s": 0.5, "jitter_s": 0.25, "loss": 0.125, "start_in_s": 2, "duration_s": 35})"),
                                        1'000'000);
  EXPECT_EQ(command.mode, link_command_t::MODE_FROZEN);
  EXPECT_FALSE(command.uplink);
  EXPECT_TRUE(command.downlink);
  EXPECT_EQ(command.delay_s, 0.5);
  EXPECT_EQ(command.jitter_s, 0.25);
  EXPECT_EQ(command.loss, 0.125);
  EXPECT_EQ(command.start_utime, 3'000'000);
  EXPECT_EQ(command.duration_s, 35);
}

TEST(LinkCommand, IsRefusedWithTheFieldThatIsWrong) {
  EXPECT_EQ(LinkRefusal(R"({"vehicle_id": 1.5, "mode": "up"})"),
            "CMD_LINK: /vehicle_id: must be a whole number, is 1.5");
  EXPECT_NE(LinkRefusal(R"({"vehicle_id": 0, "mode": "up"})").find("/vehicle_id: must be 1 .. "),
            std::string::npos);
  EXPECT_EQ(LinkRefusal(R"({"vehicle_id": 1})"), "CMD_LINK: the key \"mode\" is missing");
  EXPECT_NE(LinkRefusal(R"({"vehicle_id": 1, "mode": "off"})").find("CMD_LINK: /mode: unknown"),
            std::string::npos);
  EXPECT_NE(LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "los": 0.1})").find("CMD_LINK: /los: unknown key"),
            std::string::npos);
  EXPECT_NE(
      LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "session_id": 1})").find("/session_id: unknown key"),
      std::string::npos);
  EXPECT_NE(LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "loss": "much"})").find("/loss: must be a number"),
            std::string::npos);
  EXPECT_NE(LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "loss": 1.1})").find("/loss: must be 0 .. 1"),
            std::string::npos);
  EXPECT_NE(
      LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "uplink": 1})").find("/uplink: must be true or false"),
      std::string::npos);
  EXPECT_NE(
      LinkRefusal(R"({"vehicle_id": 1, "mode": "up", "uplink": false, "downlink": false})").find("nothing"),
      std::string::npos);
  EXPECT_NE(LinkRefusal("[]").find("must be an object"), std::string::npos);
  EXPECT_NE(LinkRefusal("null").find("must be an object"), std::string::npos);
}

TEST(PayloadCommand, NamesItsVehicles) {
  const auto command = ParsePayloadCommand(json::parse(R"({"vehicle_ids": [1, 3], "on": true})"));
  EXPECT_EQ(command.vehicle_ids, (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(command.num_vehicle_ids, 2);
  EXPECT_TRUE(command.on);
  EXPECT_EQ(Refusal(ParsePayloadCommand, R"({"vehicle_ids": [], "on": true})"),
            "CMD_PAYLOAD: /vehicle_ids: names no UAV");
  EXPECT_NE(Refusal(ParsePayloadCommand, R"({"vehicle_ids": [1, "two"], "on": true})")
                .find("/vehicle_ids/1: must be"),
            std::string::npos);
}

TEST(FormationCommand, NeedsSlotsOnlyToBeApplied) {
  const auto apply = ParseFormationCommand(json::parse(R"({"action": "apply", "formation": {"formation_id": 2,
      "name": "Alpha", "shape": "vee", "spacing_m": 500, "radius_m": 200,
      "parameters": [{"name": "k", "value": 0.5}],
      "slots": [{"vehicle_id": 1, "forward_m": -1000, "left_m": 0}]}})"));
  EXPECT_EQ(apply.action, formation_command_t::ACTION_APPLY);
  EXPECT_EQ(apply.formation.formation_id, 2);
  EXPECT_EQ(apply.formation.control, "skein");
  EXPECT_EQ(apply.formation.num_slots, 1);
  EXPECT_EQ(apply.formation.slots.at(0).forward_m, -1000);
  EXPECT_EQ(apply.formation.d_mod_m, 200);
  EXPECT_EQ(apply.formation.num_parameters, 1);
  const auto hold =
      ParseFormationCommand(json::parse(R"({"action": "hold", "formation": {"formation_id": 2}})"));
  EXPECT_EQ(hold.action, formation_command_t::ACTION_HOLD);
  EXPECT_EQ(Refusal(ParseFormationCommand, R"({"action": "apply", "formation": {"formation_id": 2}})"),
            "CMD_FORMATION: /formation: has no slots");
  EXPECT_NE(Refusal(ParseFormationCommand, R"({"action": "apply", "formation": {"formation_id": 2,
      "slots": [{"vehicle_id": 1, "forward_m": 0, "left_m": 0}, {"vehicle_id": 2, "left_m": 0}]}})")
                .find("CMD_FORMATION: /formation/slots/1: the key \"forward_m\" is missing"),
            std::string::npos);
  EXPECT_NE(Refusal(ParseFormationCommand, R"({"action": "explode", "formation": {"formation_id": 2}})")
                .find("/action"),
            std::string::npos);
  EXPECT_NE(Refusal(ParseFormationCommand,
                    R"({"action": "hold", "formation": {"formation_id": 2, "shape": "blob"}})")
                .find("/formation/shape"),
            std::string::npos);
}

TEST(PathCommand, MayBeEmptyButNotTooLong) {
  const auto path = ParsePathCommand(json::parse(R"({"formation_id": 1, "closed": true,
      "waypoints": [{"east_m": 1, "north_m": 2, "up_m": 3, "speed_m_s": 50, "turn_radius_m": 800}]})"));
  EXPECT_TRUE(path.closed);
  ASSERT_EQ(path.num_waypoints, 1);
  EXPECT_EQ(path.waypoints[0].north_m, 2);
  EXPECT_EQ(path.waypoints[0].turn_radius_m, 800);
  EXPECT_EQ(ParsePathCommand(json::parse(R"({"formation_id": 1, "waypoints": []})")).num_waypoints, 0);
  json endless = {{"formation_id", 1}, {"waypoints", json::array()}};
  for (int i = 0; i < 1001; ++i) endless["waypoints"].push_back({{"east_m", i}});
  EXPECT_NE(Refusal(ParsePathCommand, endless.dump().c_str()).find("/waypoints: holds more than 1000"),
            std::string::npos);
  EXPECT_NE(
      Refusal(ParsePathCommand, R"({"formation_id": 1, "waypoints": [{"east_m": 1, "north_m": 2, "up_m": 3,
      "speed_m_s": 0}]})")
          .find("/waypoints/0/speed_m_s: must be"),
      std::string::npos);
}

TEST(RecordingCommand, HasATextWithAMarkerOnly) {
  const auto marker =
      ParseRecordingCommand(json::parse(R"({"action": "marker", "text": "gusts", "operator_name": "Ann"})"));
  EXPECT_EQ(marker.action, recording_command_t::ACTION_MARKER);
  EXPECT_EQ(marker.text, "gusts");
  EXPECT_EQ(marker.operator_name, "Ann");
  const auto stop = ParseRecordingCommand(json::parse(R"({"action": "stop"})"));
  EXPECT_EQ(stop.action, recording_command_t::ACTION_STOP);
  EXPECT_EQ(stop.operator_name, "web");
  EXPECT_NE(Refusal(ParseRecordingCommand, R"({"action": "marker"})").find("text"), std::string::npos);
  EXPECT_EQ(Refusal(ParseRecordingCommand, R"({"action": "start", "text": "x"})"),
            "CMD_RECORDING: /text: goes with marker only");
  // Receivers would refuse the whole message, and nobody would answer.
  EXPECT_EQ(Refusal(ParseRecordingCommand, R"({"action": "marker", "text": "a\u007f"})"),
            "CMD_RECORDING: /text: has a control character in it");
}

TEST(AlarmCommand, NamesAlarmsOrAllUpToOne) {
  const auto one = ParseAlarmCommand(json::parse(
      R"({"action": "acknowledge", "alarm_session_id": 1795316000123456, "alarm_ids": [7], "operator_name": "Ann"})"));
  EXPECT_EQ(one.action, alarm_command_t::ACTION_ACKNOWLEDGE);
  EXPECT_EQ(one.alarm_session_id, 1795316000123456);
  ASSERT_EQ(one.num_alarm_ids, 1);
  EXPECT_EQ(one.alarm_ids[0], 7);
  EXPECT_EQ(one.operator_name, "Ann");
  const auto all = ParseAlarmCommand(
      json::parse(R"({"action": "acknowledge", "alarm_session_id": 5, "all_up_to_id": 12})"));
  EXPECT_EQ(all.all_up_to_id, 12);
  EXPECT_EQ(all.operator_name, "web");
  EXPECT_EQ(Refusal(ParseAlarmCommand, R"({"action": "acknowledge", "alarm_session_id": 5})"),
            "CMD_ALARM: names no alarm");
  EXPECT_NE(Refusal(ParseAlarmCommand, R"({"action": "shelve", "alarm_session_id": 5, "alarm_ids": [1.5]})")
                .find("/alarm_ids/0: must be a whole number"),
            std::string::npos);
  EXPECT_NE(Refusal(ParseAlarmCommand, R"({"action": "shelve", "alarm_session_id": 5, "alarm_ids": [1]})")
                .find("duration_s"),
            std::string::npos);
}

}  // namespace
}  // namespace skein::bridge

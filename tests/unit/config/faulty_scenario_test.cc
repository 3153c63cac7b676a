#include <ostream>
#include <string>
#include <vector>

#include "config/scenario.h"
#include "scenario_file.h"

namespace skein::config {
namespace {

/// What LoadScenario says of a text, without the name of the file that must come first; "" when it is
/// accepted.
std::string Refusal(const std::string& text) {
  const ScenarioFile file(text);
  try {
    LoadScenario(file.path());
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    const std::string prefix = file.path().string() + ": ";
    EXPECT_EQ(message.substr(0, prefix.size()), prefix);
    return message.substr(std::min(prefix.size(), message.size()));
  }
  return "";
}

/// A scenario that is right but for one JSON patch operation (or several), and what is said of it.
struct Fault {
  const char* operation;
  const char* message;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.operation; }

class FaultyScenario : public testing::TestWithParam<Fault> {};

TEST_P(FaultyScenario, IsRefusedWithPlaceAndReason) {
  const auto patch = nlohmann::json::parse("[" + std::string(GetParam().operation) + "]");
  EXPECT_EQ(Refusal(ThreeUavs().patch(patch).dump()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Keys, FaultyScenario,
    testing::Values(Fault{R"({"op": "add", "path": "/vehicles/2/sped_m_s", "value": 60})",
                          R"(/vehicles/2/sped_m_s: unknown key; did you mean "speed_m_s"?)"},
                    Fault{R"({"op": "add", "path": "/weather", "value": "fine"})", "/weather: unknown key"},
                    Fault{R"({"op": "add", "path": "/a~1b", "value": 1})", "/a~1b: unknown key"},
                    Fault{R"({"op": "remove", "path": "/vehicles/1/up_m"})",
                          R"(/vehicles/1: the key "up_m" is missing)"},
                    Fault{R"({"op": "remove", "path": "/vehicles"})", R"(the key "vehicles" is missing)"},
                    Fault{R"({"op": "remove", "path": "/name"})", R"(the key "name" is missing)"},
                    Fault{R"({"op": "remove", "path": "/origin"})", R"(the key "origin" is missing)"},
                    Fault{R"({"op": "remove", "path": "/formations/1/leader"})",
                          R"(/formations/1: the key "leader" is missing)"},
                    Fault{R"({"op": "remove", "path": "/formations/0/slots"})",
                          R"(/formations/0: the key "slots" is missing)"},
                    Fault{R"({"op": "remove", "path": "/formations/1/vehicles"})",
                          R"(/formations/1: the key "vehicles" is missing)"}));

INSTANTIATE_TEST_SUITE_P(
    Types, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "replace", "path": "/vehicles/2/speed_m_s", "value": "fast"})",
              "/vehicles/2/speed_m_s: must be a number, is a text"},
        Fault{R"({"op": "replace", "path": "/vehicles/0/speed_m_s", "value": null})",
              "/vehicles/0/speed_m_s: must be a number, is null"},
        Fault{R"({"op": "replace", "path": "/vehicles/0/id", "value": 1.5})",
              "/vehicles/0/id: must be a whole number, is 1.5"},
        Fault{R"({"op": "replace", "path": "/vehicles", "value": {}})",
              "/vehicles: must be an array, is an object"},
        Fault{R"({"op": "replace", "path": "/vehicles/1", "value": 7})",
              "/vehicles/1: must be an object, is a number"},
        Fault{R"({"op": "replace", "path": "/name", "value": 7})", "/name: must be a text, is a number"},
        Fault{R"({"op": "replace", "path": "/name", "value": ""})", "/name: must not be empty"},
        Fault{R"({"op": "replace", "path": "/name", "value": "bell\u0007"})",
              "/name: has a control character in it"},
        Fault{R"({"op": "add", "path": "/vehicles/0/payload", "value": 1})",
              "/vehicles/0/payload: must be true or false, is a number"},
        Fault{R"({"op": "replace", "path": "", "value": []})", "must be an object, is an array"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "replace", "path": "/vehicles/2/speed_m_s", "value": 200})",
              "/vehicles/2/speed_m_s: must be 30 .. 90, is 200"},
        Fault{R"({"op": "replace", "path": "/origin/latitude_deg", "value": 91})",
              "/origin/latitude_deg: must be -89 .. 89, is 91"},
        Fault{R"({"op": "replace", "path": "/duration_s", "value": 0})",
              "/duration_s: must be 0.05 .. 1000000, is 0"},
        Fault{R"({"op": "replace", "path": "/vehicles/0/id", "value": 0})",
              "/vehicles/0/id: must be 1 .. 1000000, is 0"},
        Fault{R"({"op": "replace", "path": "/vehicles/0/id", "value": 99999999999999999999})",
              "/vehicles/0/id: must be 1 .. 1000000, is 1e+20"},
        Fault{R"({"op": "replace", "path": "/formations/1/spacing_m", "value": 0})",
              "/formations/1/spacing_m: must be 1 .. 100000, is 0"},
        Fault{R"({"op": "add", "path": "/link", "value": {"up": {"loss": 1.5}}})",
              "/link/up/loss: must be 0 .. 1, is 1.5"},
        Fault{R"({"op": "add", "path": "/vehicles/0/autopilot_scale", "value": 0})",
              "/vehicles/0/autopilot_scale: must be 0.1 .. 10, is 0"},
        Fault{R"({"op": "add", "path": "/vehicles/0/model", "value": {"envelope": {"min_speed_m_s": 95}}})",
              "/vehicles/0/model/envelope: max_speed_m_s must be greater than min_speed_m_s"},
        Fault{R"({"op": "replace", "path": "/timeline/0/at_s", "value": -1})",
              "/timeline/0/at_s: must be 0 .. 1000000, is -1"}));

INSTANTIATE_TEST_SUITE_P(
    Names, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "replace", "path": "/formations/1/shape", "value": "colum"})",
              R"(/formations/1/shape: unknown shape "colum"; did you mean "column"?)"},
        Fault{R"({"op": "add", "path": "/control", "value": "sekin"})",
              R"(/control: unknown control "sekin"; did you mean "skein"?)"},
        Fault{R"({"op": "add", "path": "/formations/0/control", "value": "manual"})",
              R"(/formations/0/control: unknown control "manual"; there are "skein", "paper")"},
        Fault{R"({"op": "add", "path": "/uplink_loss", "value": "land"})",
              R"(/uplink_loss: unknown uplink_loss "land"; there are "hold", "keep")"},
        Fault{R"({"op": "add", "path": "/vehicles/0/model", "value": "glider"})",
              R"(/vehicles/0/model: unknown model "glider"; there are "default")"},
        Fault{
            R"({"op": "add", "path": "/formations/0", "value": {"id": 7, "control": "paper", "gains": {"k_ev": 2,
                 "k_xy": 1}}})",
            R"(/formations/0/gains/k_xy: control "paper" has no gain "k_xy")"},
        Fault{R"({"op": "add", "path": "/formations/0/gains", "value": {"k_ev": 2}})",
              R"(/formations/0/gains/k_ev: k_ev: control "skein" has no such gain)"},
        Fault{R"({"op": "add", "path": "/timeline/0/direction", "value": "sideways"})",
              R"(/timeline/0/direction: unknown direction "sideways"; there are "up", "down", "both")"}));

INSTANTIATE_TEST_SUITE_P(
    Relations, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "replace", "path": "/vehicles/2/id", "value": 1})",
              "/vehicles/2/id: UAV 1 is there already, at /vehicles/0/id"},
        Fault{R"({"op": "replace", "path": "/vehicles/2/callsign", "value": "UAV1"})",
              R"(/vehicles/2/callsign: UAV 1 has the callsign "UAV1" already)"},
        Fault{R"({"op": "replace", "path": "/formations/1/id", "value": 1})",
              "/formations/1/id: formation 1 is there already, at /formations/0/id"},
        Fault{R"({"op": "replace", "path": "/formations/0/slots/1/vehicle", "value": 9})",
              "/formations/0/slots/1/vehicle: there is no UAV 9 in this scenario"},
        Fault{
            R"({"op": "replace", "path": "/formations/1/vehicles/0", "value": 2})",
            "/formations/1/vehicles/0: the slot of UAV 2 is there already, at /formations/0/slots/1/vehicle"},
        Fault{R"({"op": "replace", "path": "/formations/0/slots/1/vehicle", "value": 1})",
              "/formations/0/slots/1/vehicle: the slot of UAV 1 is there already, at "
              "/formations/0/slots/0/vehicle"},
        Fault{R"({"op": "replace", "path": "/formations/0/slots", "value": []})",
              "/formations/0/slots: needs at least one slot"},
        Fault{R"({"op": "add", "path": "/formations/0/spacing_m", "value": 300})",
              R"(/formations/0/spacing_m: does not go with the shape "custom"; give slots)"},
        Fault{R"({"op": "add", "path": "/formations/1/slots", "value": []})",
              R"(/formations/1/slots: go with the shape "custom" only; give vehicles and spacing_m)"},
        Fault{
            R"({"op": "add", "path": "/formations/0/proximity", "value": {"radius_m": 300, "d_mod_m": 200}})",
            "/formations/0/proximity/d_mod_m: must be at least radius_m, or the levels would come in the "
            "wrong "
            "order"},
        Fault{R"({"op": "add", "path": "/strangers", "value": {"advisory_tau_s": 20}})",
              "/strangers: caution_tau_s must be less than advisory_tau_s"},
        Fault{R"({"op": "replace", "path": "/timeline/1/restore_link", "value": 4})",
              "/timeline/1/restore_link: there is no UAV 4 in this scenario"},
        Fault{R"({"op": "add", "path": "/timeline/1/cut_link", "value": 3})",
              R"(/timeline/1/restore_link: cannot be given beside "cut_link")"},
        Fault{R"({"op": "remove", "path": "/timeline/1/restore_link"})",
              "/timeline/1: needs cut_link, restore_link or set_link"},
        Fault{R"({"op": "add", "path": "/timeline/1/for_s", "value": 5})", "/timeline/1/for_s: unknown key"},
        Fault{R"({"op": "add", "path": "/timeline_repeat_s", "value": 30})",
              "/timeline_repeat_s: must be later than the end of the last entry of the timeline"},
        Fault{
            R"({"op": "add", "path": "/vehicles/0", "value": {"id": 7, "actual_gains": {}, "autopilot_scale": 2}})",
            R"(/vehicles/0/autopilot_scale: cannot be given beside "actual_gains")"}));

INSTANTIATE_TEST_SUITE_P(
    Paths, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "add", "path": "/formations/0/path", "value": {}})",
              "/formations/0/path: needs legs, or at least 2 waypoints"},
        Fault{R"({"op": "add", "path": "/formations/0/path", "value": {"closed": true, "waypoints": [
                 {"east_m": 0, "north_m": 0, "up_m": 1000, "speed_m_s": 50},
                 {"east_m": 0, "north_m": 9000, "up_m": 1000, "speed_m_s": 50}]}})",
              "/formations/0/path: needs legs, or at least 3 waypoints"},
        Fault{R"({"op": "add", "path": "/formations/0/path", "value": {"legs": [{"radius_m": 2000}]}})",
              "/formations/0/path/legs/0: needs straight_m, or turn_deg and radius_m"},
        Fault{R"({"op": "add", "path": "/formations/0/path", "value": {"legs": [{"turn_deg": 90}]}})",
              R"(/formations/0/path/legs/0: the key "radius_m" is missing)"},
        Fault{
            R"({"op": "add", "path": "/formations/0/path", "value": {"legs": [{"turn_deg": 0, "radius_m": 9}]}})",
            "/formations/0/path/legs/0/turn_deg: must not be 0; give a straight leg by straight_m"},
        Fault{R"({"op": "add", "path": "/formations/0/path", "value": {"waypoints": [], "legs": []}})",
              R"(/formations/0/path/legs: cannot be given beside "waypoints")"}));

INSTANTIATE_TEST_SUITE_P(
    Fleets, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "add", "path": "/fleet", "value": {"count": 4, "formations": 5}})",
              "/fleet/formations: must be 0 .. 4, is 5"},
        Fault{R"({"op": "add", "path": "/fleet", "value": {"count": 4, "formations": 0, "shape": "vee",
                 "leader": {"east_m": 0, "north_m": 0, "up_m": 500, "speed_m_s": 50, "course_deg": 0}}})",
              "/fleet/shape: needs at least one formation"},
        Fault{R"({"op": "add", "path": "/fleet", "value": {"count": 4, "formations": 1, "shape": "custom",
                 "leader": {"east_m": 0, "north_m": 0, "up_m": 500, "speed_m_s": 50, "course_deg": 0}}})",
              "/fleet/shape: must be a shape that can be generated"},
        Fault{R"({"op": "add", "path": "/fleet", "value": {"count": 1, "formations": 0, "first_id": 3,
                 "leader": {"east_m": 0, "north_m": 0, "up_m": 500, "speed_m_s": 50, "course_deg": 0}}})",
              "/fleet: UAV 3 is there already, at /vehicles/2/id"}));

TEST(FaultyFile, OfBrokenJsonIsRefusedWithLineAndColumn) {
  EXPECT_EQ(
      Refusal("{\n  \"name\": \"x\",\n  \"duration_s\" 3\n}"),
      "line 3, column 16: syntax error while parsing object separator - unexpected number literal; expected "
      "':'");
  EXPECT_EQ(Refusal("{\"name\": \"x\""),
            "line 1, column 13: syntax error while parsing object - unexpected end of input; expected '}'");
  EXPECT_NE(Refusal("{\"name\": \"\xff\"}").find("line 1, column 11"), std::string::npos);
  EXPECT_NE(Refusal("{\"duration_s\": 1e999}").find("1e999"), std::string::npos);
}

TEST(FaultyFile, ThatGivesAKeyTwiceIsRefused) {
  EXPECT_EQ(Refusal(R"({"name": "x", "vehicles": [{"id": 1}, {"id": 2, "up_m": 1, "up_m": 2}]})"),
            "/vehicles/1/up_m: is given twice");
}

TEST(FaultyFile, ThatIsEmptyIsRefused) {
  EXPECT_EQ(Refusal(""), "is empty");
  EXPECT_EQ(Refusal(" \n\t"), "is empty");
}

TEST(FaultyFile, NestedWithoutEndIsRefused) { EXPECT_NE(Refusal(std::string(1'000'000, '[')), ""); }

TEST(FaultyFile, ThatIsAFolderOrIsNotThereIsRefused) {
  const auto message = [](const char* file) -> std::string {
    try {
      LoadScenario(file);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("/"), "/: is a folder, not a scenario file");
  EXPECT_EQ(message("/no/such.json"), "/no/such.json: there is no such file");
  EXPECT_EQ(message("/dev/zero"), "/dev/zero: is larger than 32 MiB");
}

TEST(FaultyFile, IsTheOnlyOneThatIsRefused) { EXPECT_EQ(Refusal(ThreeUavs().dump()), ""); }

INSTANTIATE_TEST_SUITE_P(
    Variations, FaultyScenario,
    testing::Values(
        Fault{R"({"op": "add", "path": "/vary", "value": {"strat": {}}})",
              R"(/vary/strat: unknown key; did you mean "start"?)"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"start": {"east_m": -5}}})",
              "/vary/start/east_m: must be 0 .. 20000, is -5"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"start": {"vehicles": [1, 9]}}})",
              "/vary/start/vehicles/1: there is no UAV 9 in this scenario"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"start": {"vehicles": [2, 2]}}})",
              "/vary/start/vehicles/0: is there more than once"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"start": {"speed_m_s": 31}}})",
              "/vary/start/speed_m_s: UAV1 could start outside of 30 .. 90"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"timeline": {"at_s": 21}}})",
              "/vary/timeline/at_s: 20 s after the start is sooner than that in the timeline"},
        Fault{R"({"op": "replace", "path": "/timeline/0", "value": {"at_s": 5, "cut_link": 1, "for_s": 3}},
                {"op": "add", "path": "/vary", "value": {"timeline": {"for_s": 3}}})",
              "/vary/timeline/for_s: a link is cut for 3 s only in the timeline"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"link": {"up": {"loss": 0.1}}}})",
              "/vary/link/up/loss: must be an array, is a number"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"link": {"up": {"loss": [0.3, 0.1]}}}})",
              "/vary/link/up/loss: the first number must not be greater than the second"},
        Fault{R"({"op": "add", "path": "/vary", "value": {"autopilot_scale": [0.5, 11]}})",
              "/vary/autopilot_scale/1: must be 0.1 .. 10, is 11"}));

}  // namespace
}  // namespace skein::config

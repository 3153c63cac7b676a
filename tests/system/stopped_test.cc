// A process that is stopped for ten seconds (SIGSTOP) and goes on: that is told, and afterwards all is as it
// was.

#include <memory>
#include <nlohmann/json.hpp>
#include <skein/heartbeat_t.hpp>
#include <skein/link_status_t.hpp>
#include <string>

#include "system/faulty_flight.h"
#include "system/http.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

class StoppedTest : public FaultsTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    scenario_ = "turn";  // in formation from the start
    StartAll();
    nodes_["web-bridge"] = std::make_unique<Process>(
        std::vector<std::string>{Program("web-bridge"), "--lcm-url", url_, "--port", std::to_string(port_)});
    // A node that was heard once is not missed: three times it must have been.
    int beats = 0;
    ASSERT_TRUE(Hears<heartbeat_t>(
        url_, bus::channel::kHeartbeat,
        [&](const heartbeat_t& heartbeat) {
          return heartbeat.heartbeat_node == "web-bridge" && ++beats == 4;
        },
        10s));
    ASSERT_TRUE(HoldsSlots(20, 30s));
    ASSERT_TRUE(LinksAreUp(10s));
  }

  /// Whether that is told within so much time: by the monitor, or of the monitor by the bridge.
  bool IsTold(Seconds within) const {
    if (GetParam() == "collision-monitor") {
      const auto deadline = std::chrono::steady_clock::now() + within;
      while (std::chrono::steady_clock::now() < deadline) {
        const json health = json::parse(HttpGet(port_, "/api/health").value_or("{}"));
        if (health.contains("nodes_silent") && health["nodes_silent"] == json{GetParam()}) return true;
      }
      return false;
    }
    const std::string condition =
        GetParam() == "fleet-simulator" ? "fleet_silent" : "node_silent:" + GetParam();
    return HearsAlarm(condition, IsOn, within);
  }
  static bool IsOn(const alarm_t& alarm) {
    return alarm.state == alarm_t::UNACKNOWLEDGED || alarm.state == alarm_t::ACKNOWLEDGED;
  }
  bool LinksAreUp(Seconds within) const {
    return Hears<link_status_t>(
        url_, bus::channel::kLinkStatus,
        [](const link_status_t& status) {
          return status.num_links == 3 && std::ranges::all_of(status.links, [](const vehicle_link_t& link) {
                   return link.downlink == link_status_t::LINK_UP && link.uplink == link_status_t::LINK_UP;
                 });
        },
        within);
  }

  int port_ = FreeTcpPort();
};

TEST_P(StoppedTest, IsToldAndAllIsAsBeforeWhenItGoesOn) {
  const std::int64_t flight = NextState().session_id;
  const Process& stopped = *nodes_.at(GetParam());
  const auto since = std::chrono::steady_clock::now();
  stopped.Signal(SIGSTOP);
  EXPECT_TRUE(IsTold(5s));
  // What it is about is how long it was stopped: nobody climbs meanwhile.
  const auto climbs = [](const formation_status_t& status) {
    return status.avoidance_up_m != 0 || status.avoidance_target_m != 0;
  };
  EXPECT_FALSE(Hears<formation_status_t>(url_, bus::channel::kFormationStatus, climbs,
                                         10s - (std::chrono::steady_clock::now() - since)));
  stopped.Signal(SIGCONT);
  // Nor afterwards, and nothing is said to be wrong that is not: what was said of the one that was stopped
  // ends, and there is nothing else.
  std::string false_alarms;
  const bool told_more = Hears<alarm_list_t>(
      url_, bus::channel::kAlarms,
      [&](const alarm_list_t& list) {
        for (const alarm_t& alarm : list.alarms) {
          const bool of_it = alarm.condition == "node_silent:" + GetParam() ||
                             (GetParam() == "fleet-simulator" && alarm.condition == "fleet_silent");
          if (!of_it) false_alarms += alarm.condition + ": " + alarm.text + "\n";
        }
        return !false_alarms.empty();
      },
      8s);
  EXPECT_FALSE(told_more) << false_alarms;
  EXPECT_FALSE(Hears<formation_status_t>(url_, bus::channel::kFormationStatus, climbs, 4s));
  EXPECT_FALSE(HearsAlarm("node_silent:" + GetParam(), IsOn, 2s));
  EXPECT_FALSE(HearsAlarm("fleet_silent", IsOn, 1s));
  EXPECT_TRUE(LinksAreUp(5s));
  EXPECT_TRUE(HoldsSlots(20, 30s));
  EXPECT_EQ(NextState().session_id, flight) << "another flight has begun";
  for (const auto& [node, process] : nodes_) EXPECT_EQ(process->WaitForEnd(0s), std::nullopt) << node;
  const json health = json::parse(HttpGet(port_, "/api/health").value_or("{}"));
  EXPECT_EQ(health["nodes_silent"], json::array());
  Skein({"formation", "hold", "1"});
}

INSTANTIATE_TEST_SUITE_P(Skein, StoppedTest,
                         ::testing::Values("fleet-simulator", "formation-controller", "collision-monitor",
                                           "web-bridge"),
                         [](const auto& named) {
                           std::string name = named.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace skein::testing

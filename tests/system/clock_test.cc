// The wall clock of the host is set while a flight is on. libfaketime stands for whoever sets it, for what it
// is loaded into alone.

#include <filesystem>
#include <fstream>
#include <skein/event_t.hpp>
#include <skein/link_status_t.hpp>

#include "system/fake_time.h"
#include "system/faulty_flight.h"

namespace skein::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class ClockTest : public FaultsTest, public ::testing::WithParamInterface<std::string> {
 protected:
  ClockTest() {
    scenario_ = "turn";  // in formation from the start
    environment_ = {{"LD_PRELOAD", FakeTimeLibrary()},
                    {"FAKETIME_TIMESTAMP_FILE", folder_ + "/wall-clock"},
                    {"FAKETIME_NO_CACHE", "1"},
                    {"FAKETIME_DONT_FAKE_MONOTONIC", "1"},
                    {"SKEIN_CLOCK_FILE", folder_ + "/clock"}};
    SetWallClock("+0");
  }
  void SetWallClock(const std::string& by) const {
    std::ofstream(folder_ + "/wall-clock.new") << by << "\n";
    fs::rename(folder_ + "/wall-clock.new", folder_ + "/wall-clock");
  }
  /// Whether a link is said to be anything but up within so much time.
  bool HearsLinkTrouble(Seconds within) const {
    return Hears<link_status_t>(
        url_, bus::channel::kLinkStatus,
        [](const link_status_t& status) {
          return std::ranges::any_of(status.links, [](const vehicle_link_t& link) {
            return link.downlink == link_status_t::LINK_LOST || link.uplink == link_status_t::LINK_LOST;
          });
        },
        within);
  }
};

TEST_P(ClockTest, NobodyMindsThatItIsSetByAnHour) {
  ASSERT_NE(FakeTimeLibrary(), "") << "libfaketime is missing: scripts/setup test";
  StartAll();
  const std::int64_t flight = NextState().session_id;
  SetWallClock(GetParam());
  EXPECT_TRUE(HearsAlarm(
      "wall-clock", [](const alarm_t&) { return true; }, 10s));
  EXPECT_FALSE(HearsLinkTrouble(6s));
  EXPECT_TRUE(HoldsSlots(20, 5s));
  // Who is started after it, too.
  for (const std::string& node : kNodes) {
    SCOPED_TRACE(node);
    Restart(node);
    ASSERT_TRUE(HearsHeartbeat(url_, node));
    const fleet_state_t before = NextState();
    EXPECT_TRUE(Hears<fleet_state_t>(
        url_, bus::channel::kFleetState,
        [&](const fleet_state_t& state) { return state.utime - before.utime > 3 * bus::kSecond; }, 6s))
        << "time stands still";
    EXPECT_TRUE(HoldsSlots(20, 10s));
    EXPECT_FALSE(HearsLinkTrouble(2s));
    EXPECT_EQ(NextState().session_id, flight) << "another flight has begun";
  }
  const auto of_clocks = [](const alarm_list_t& list) {
    return std::ranges::any_of(list.alarms,
                               [](const alarm_t& alarm) { return alarm.condition.starts_with("clock:"); });
  };
  EXPECT_FALSE(Hears<alarm_list_t>(url_, bus::channel::kAlarms, of_clocks, 2s))
      << "somebody goes by another clock";
  Skein({"formation", "hold", "1"});
  Skein({"formation", "resume", "1"});
}

INSTANTIATE_TEST_SUITE_P(ForwardAndBack, ClockTest, ::testing::Values("+3600", "-3600"),
                         [](const auto& named) { return named.param[0] == '+' ? "Forward" : "Back"; });

}  // namespace
}  // namespace skein::testing

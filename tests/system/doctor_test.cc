// skein doctor, on a bus with somebody on it and on one that cannot be.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "system/bus_ear.h"
#include "system/process.h"

namespace skein::testing {
namespace {

TEST(Doctor, TellsWhoIsHeardAndEndsWellWhenAllWillWork) {
  const std::string url = FreshLcmUrl();
  const Process monitor({Program("collision-monitor"), "--lcm-url", url});
  ASSERT_TRUE(HearsHeartbeat(url, "collision-monitor"));
  const Finished told = RunToEnd({Program("skein"), "--lcm-url", url, "doctor", "--json"});
  EXPECT_EQ(told.exit_code, 0) << told.output;
  std::map<std::string, nlohmann::json> about;
  for (const nlohmann::json& finding : nlohmann::json::parse(told.output)) about[finding["about"]] = finding;
  for (const char* what : {"bus", "receive buffer", "exposure", "clock", "disk", "collision-monitor"}) {
    ASSERT_TRUE(about.contains(what)) << what << " in " << told.output;
    EXPECT_EQ(about[what]["health"] == "good", about[what]["do"] == "") << about[what];
  }
  EXPECT_EQ(about["collision-monitor"]["health"], "good");
}

TEST(Doctor, SaysWhatIsWrongWithABusThatCannotBeAndWhatToDo) {
  const Finished told = RunToEnd({Program("skein"), "--lcm-url", "udpm://10.0.0.1:7667", "doctor"});
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_NE(told.output.find("10.0.0.1 is not a multicast address"), std::string::npos) << told.output;
  const Finished no_room = RunToEnd({Program("skein"), "doctor", "--folder", "/proc/none"});
  EXPECT_NE(no_room.output.find("do: make room"), std::string::npos) << no_room.output;
}

}  // namespace
}  // namespace skein::testing

// scripts/link-drop with real processes: what is cut, what the monitor finds, what is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <skein/link_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/drop_report.h"
#include "system/live_flight.h"
#include "system/process.h"

namespace skein::testing {
namespace {

const std::string kLinkDrop = SKEIN_SOURCE_DIR "/scripts/link-drop";

/// Five in a column, under way. Detections are given 10 s: that 5 s are enough is tested on a simulated
/// clock, where no machine is too busy.
class LinkDropTest : public ::testing::Test {
 protected:
  ~LinkDropTest() override { std::filesystem::remove_all(folder_); }

  std::string File(const std::string& name) const { return folder_ + "/" + name; }

  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(File(name)) << text;
    return File(name);
  }

  std::vector<std::string> Command(std::vector<std::string> words) const {
    words.insert(words.begin(), {kLinkDrop, "--lcm-url", flight_.lcm_url()});
    return words;
  }

  Finished Drop(const std::vector<std::string>& words) const { return RunToEnd(Command(words), Seconds(90)); }

 private:
  std::string folder_ = FreshFolder("skein-link-drop");
  LiveFlight flight_{SKEIN_SOURCE_DIR "/scripts/scenarios/column.json", folder_ + "/flight.lcm"};
};

TEST_F(LinkDropTest, TellsOfAListWhatWasFoundAndWhen) {
  const std::string list =
      Write("drops.csv",
            "at_s,uav,direction,for_s,loss,delay_s\n"
            "4,UAV1,both,12,,\n4,2,down,12,,\n4,3,up,12,,\n4,4,both,1.5,,\n4,5,both,6,0.2,0.2\n"
            "8,UAV1,up,14,,\n");
  const Finished ended = Drop({"--list", list, "--from-now", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  const auto report = DropReportIn(ended.output);
  std::map<int, nlohmann::json> drops;
  for (const auto& drop : report["drops"]) drops[drop["number"]] = drop;
  ASSERT_EQ(drops.size(), 6u);
  for (const int number : {1, 2, 3}) {
    EXPECT_EQ(drops[number]["outcome"], "found") << ended.output;
    EXPECT_GT(drops[number]["detection_s"], 3.5) << "sooner than a link can be told lost";
    EXPECT_LE(drops[number]["detection_s"], 5);
  }
  EXPECT_GT(drops[2]["back_up_after_s"], 2.5);
  EXPECT_EQ(drops[4]["outcome"], "short");
  EXPECT_EQ(drops[5]["outcome"], "degraded");
  EXPECT_EQ(drops[6]["outcome"], "overlapped");
  EXPECT_EQ(report["summary"]["found"], 3);
  EXPECT_EQ(report["summary"]["missed"], 0);
  EXPECT_EQ(report["summary"]["false"], 0) << ended.output;
}

TEST_F(LinkDropTest, EndsWithOneWhenACutIsFoundTooLate) {
  const Finished ended = Drop({"UAV3", "--at", "6", "--for", "5.5", "--limit", "2"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("6.00 s  UAV3 cut both ways for 5.5 s"), std::string::npos) << ended.output;
  EXPECT_NE(ended.output.find("1 found (cuts: median "), std::string::npos) << ended.output;
  EXPECT_NE(ended.output.find("1 drop was missed or found after more than 2 s"), std::string::npos)
      << ended.output;
}

TEST_F(LinkDropTest, RestoresLinksWhenRandomDropsAreStopped) {
  Process drops(
      Command({"--random", "--seed", "5", "--rate", "600", "--shortest", "300", "--longest", "300"}));
  ASSERT_TRUE(drops.WaitForOutput("found lost after", Seconds(30))) << drops.output();
  drops.Signal(SIGINT);
  EXPECT_EQ(drops.WaitForEnd(Seconds(20)), 0) << drops.output();
  EXPECT_NE(drops.output().find("drops of links: "), std::string::npos) << drops.output();
  EXPECT_TRUE(Hears<link_status_t>(
      Command({})[2], bus::channel::kLinkStatus,
      [](const link_status_t& status) {
        return status.links.size() == 5 &&
               std::all_of(status.links.begin(), status.links.end(), [](const auto& link) {
                 return link.uplink == link_status_t::LINK_UP && link.downlink == link_status_t::LINK_UP;
               });
      },
      Seconds(20)));
}

TEST_F(LinkDropTest, RefusesWhatItCannotDo) {
  EXPECT_EQ(Drop({}).exit_code, 2);
  EXPECT_EQ(Drop({"1", "--direction", "any"}).exit_code, 2);
  const Finished stranger = Drop({"UAV9"});
  EXPECT_EQ(stranger.exit_code, 1);
  EXPECT_NE(stranger.output.find("there is no UAV \"UAV9\" in this fleet"), std::string::npos)
      << stranger.output;
  const Finished faulty = Drop({"--list", Write("faulty.csv", "at_s,uav\n1,2\n")});
  EXPECT_EQ(faulty.exit_code, 2);
  EXPECT_NE(faulty.output.find("line 2: the key \"for_s\" is missing"), std::string::npos) << faulty.output;
  const Finished past = Drop({"--list", Write("past.csv", "at_s,uav,for_s\n0,2,7\n")});
  EXPECT_EQ(past.exit_code, 1);
  EXPECT_NE(past.output.find("--from-now counts from now"), std::string::npos) << past.output;
}

}  // namespace
}  // namespace skein::testing

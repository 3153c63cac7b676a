// scripts/netem-demo: real wires between network namespaces, and tc.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "system/drop_report.h"
#include "system/process.h"

namespace skein::testing {
namespace {

const std::string kNetemDemo = SKEIN_SOURCE_DIR "/scripts/netem-demo";

/// scripts/netem-demo, for root alone.
class NetemDemo : public ::testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "needs root";
  }
  ~NetemDemo() override {
    std::filesystem::remove_all(folder_);
    // Other tests have namespaces of their own meanwhile.
    const std::string left = RunToEnd({"ip", "netns", "list"}).output;
    EXPECT_FALSE(std::regex_search(left, std::regex("skein-(sim|net|page|station)-"))) << left;
  }

  Finished Run(const std::string& drops, const std::vector<std::string>& options) {
    std::ofstream(folder_ + "/drops.csv") << "at_s,uav,direction,for_s,loss,delay_s\n" << drops;
    std::vector<std::string> command{kNetemDemo, "--list", folder_ + "/drops.csv", "--json"};
    command.insert(command.end(), options.begin(), options.end());
    return RunToEnd(command, Seconds(250));
  }

 private:
  std::string folder_ = FreshFolder("skein-netem");
};

TEST_F(NetemDemo, FindsEachDirectionOfARealWireThatIsCut) {
  const Finished ended =
      Run("1,all,both,11,,\n18,all,down,11,,\n35,all,up,11,,\n50,none,both,6,,\n", {"--cuts-only"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  const auto summary = DropReportIn(ended.output)["summary"];
  EXPECT_EQ(summary["found"], 15) << ended.output;
  EXPECT_GT(summary["detection_median_s"], 3.5) << "sooner than a link can be told lost";
  EXPECT_EQ(summary["false"], 0) << ended.output;
}

TEST_F(NetemDemo, RefusesAListThatItCannotDoBeforeAnythingIsStarted) {
  const Finished lossy = Run("1,all,both,11,,\n18,all,both,4,0.1,\n", {"--cuts-only"});
  EXPECT_EQ(lossy.exit_code, 2);
  EXPECT_NE(lossy.output.find("--cuts-only only cuts"), std::string::npos) << lossy.output;
  EXPECT_NE(lossy.output.find("the drop at 18 s"), std::string::npos) << lossy.output;
  const Finished single = Run("1,all,both,11,,\n18,UAV3,both,4,,\n", {});
  EXPECT_EQ(single.exit_code, 2);
  EXPECT_NE(single.output.find("uav must be all"), std::string::npos) << single.output;
  const Finished faulty = Run("1,all,both,,,\n", {"--uml"});
  EXPECT_EQ(faulty.exit_code, 2);
  EXPECT_NE(faulty.output.find("line 2: the key \"for_s\" is missing"), std::string::npos) << faulty.output;
}

// The User-Mode Linux where this kernel has no netem is slow, hence the limit.
TEST_F(NetemDemo, TellsAWireThatIsCutFromOneThatIsBadWithNetem) {
  const std::string drops = "1,all,down,16,,\n32,all,both,4,0.1,0.2\n";
  Finished ended = Run(drops, {"--limit", "15"});
  if (ended.exit_code == 77) {
    if (RunToEnd({"bash", "-c", "command -v linux.uml"}).exit_code != 0) GTEST_SKIP() << ended.output;
    ended = Run(drops, {"--limit", "15", "--uml"});
    if (ended.exit_code == 77) GTEST_SKIP() << ended.output;
  }
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  const auto summary = DropReportIn(ended.output)["summary"];
  EXPECT_EQ(summary["found"], 5) << ended.output;
  EXPECT_EQ(summary["degraded"], 5) << ended.output;
  EXPECT_EQ(summary["false"], 0) << ended.output;
}

TEST_F(NetemDemo, TakesEverythingAwayWhenInterrupted) {
  Process demo({kNetemDemo, "--cuts-only"});
  ASSERT_TRUE(demo.WaitForOutput("cut both ways", Seconds(90))) << demo.output();
  const auto started = ProcessesWith("239.255.76.67:7667?ttl=1");
  EXPECT_GE(started.size(), 5u);
  demo.Signal(SIGINT);
  EXPECT_TRUE(demo.WaitForEnd(Seconds(30)));
  EXPECT_TRUE(WaitUntilGone(started, Seconds(5)));
}

}  // namespace
}  // namespace skein::testing

// lcm-spy and `skein spy` on real buses.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const std::string kSource = SKEIN_SOURCE_DIR;
const std::string kLcmJar = "/usr/share/java/lcm.jar";

/// A display without a screen.
class Display {
 public:
  Display() {
    // It prints its number.
    EXPECT_TRUE(server_.WaitForOutput("\n", 20s)) << server_.output();
    number_ = server_.output().substr(0, server_.output().find('\n'));
  }
  std::string name() const { return ":" + number_; }

 private:
  Process server_{{"Xvfb", "-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"}};
  std::string number_;
};

/// lcm-spy, which prints the rows of its tables, too (SpyWindow.java).
class SpyScript : public ::testing::Test {
 protected:
  void SetUp() override {
    const Finished compiled =
        RunToEnd({"javac", "--release", "11", "-d", folder_, kSource + "/tests/system/SpyWindow.java"}, 120s);
    ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
    std::ofstream(folder_ + "/manifest") << "Premain-Class: SpyWindow\n";
    const Finished packed = RunToEnd({"jar", "--create", "--file", folder_ + "/agent.jar", "--manifest",
                                      folder_ + "/manifest", "-C", folder_, "SpyWindow.class"},
                                     120s);
    ASSERT_EQ(packed.exit_code, 0) << packed.output;
  }
  ~SpyScript() override { std::filesystem::remove_all(folder_); }

  void ExpectThatItDecodes(const std::string& lcm_url) {
    const auto types = std::count_if(std::filesystem::directory_iterator(kSource + "/lcmtypes"),
                                     std::filesystem::directory_iterator(),
                                     [](const auto& entry) { return entry.path().extension() == ".lcm"; });
    Process spy(
        {kSource + "/scripts/spy", "--lcm-url", lcm_url},
        {{"DISPLAY", display_.name()}, {"JAVA_TOOL_OPTIONS", "-javaagent:" + folder_ + "/agent.jar"}});
    EXPECT_TRUE(spy.WaitForOutput("Found " + std::to_string(types) + " LCM types", 120s)) << spy.output();
    // Channel, type, messages, four rates, undecodable.
    EXPECT_TRUE(spy.WaitForOutput("row FLEET_STATE | fleet_state_t | ", 60s)) << spy.output();
    EXPECT_TRUE(spy.WaitForOutput("row HEARTBEAT | heartbeat_t | ", 60s)) << spy.output();
    const std::string rows = spy.output();
    const std::regex row(
        R"(row (FLEET_STATE|FLEET_ROSTER|HEARTBEAT) \| \w+ \| [1-9][0-9]* \|.*\| ([0-9]+)\n)");
    for (std::sregex_iterator match(rows.begin(), rows.end(), row); match != std::sregex_iterator();
         ++match) {
      EXPECT_EQ((*match)[2], "0") << match->str();
    }
    spy.Signal(SIGTERM);
    EXPECT_TRUE(spy.WaitForEnd(20s));
  }

  std::string folder_ = FreshFolder("skein-spy");
  Display display_;
};

TEST_F(SpyScript, DecodesALiveBus) {
  const std::string url = FreshLcmUrl();
  const Process simulator({Program("fleet-simulator"), "--scenario", "triangle", "--lcm-url", url});
  ExpectThatItDecodes(url);
}

TEST_F(SpyScript, DecodesWhatGoesThroughAHub) {
  const std::string port = std::to_string(FreeTcpPort());
  const std::string url = "tcpq://127.0.0.1:" + port;
  const Process hub({"java", "-Djava.net.preferIPv4Stack=true", "-cp", kLcmJar, "lcm.lcm.TCPService", port});
  // Nodes give up when there is no hub yet.
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  while (RunToEnd({"bash", "-c", "exec 3<>/dev/tcp/127.0.0.1/" + port}).exit_code != 0) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the hub does not listen";
  }
  const Process simulator({Program("fleet-simulator"), "--scenario", "triangle", "--lcm-url", url});
  ExpectThatItDecodes(url);
  const Finished spy =
      RunToEnd({Program("skein"), "--lcm-url", url, "spy", "FLEET_STATE", "--once", "--json"});
  EXPECT_EQ(spy.exit_code, 0) << spy.output;
  // LCM itself says on standard error that it connects.
  const std::size_t begin = spy.output.find('{');
  ASSERT_NE(begin, std::string::npos) << spy.output;
  const std::string message = spy.output.substr(begin, spy.output.rfind('}') + 1 - begin);
  EXPECT_EQ(json::parse(message)["fields"]["vehicles"].size(), 3U);
}

TEST(SpyScriptWithout, ADisplayTellsOfTheSpyInTheTerminal) {
  const Finished spy =
      RunToEnd({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", kSource + "/scripts/spy"}, 60s);
  EXPECT_EQ(spy.exit_code, 1);
  EXPECT_NE(spy.output.find("skein spy"), std::string::npos) << spy.output;
}

TEST(SkeinSpy, ShowsAFlightChannelByChannelAndFieldByField) {
  const std::string url = FreshLcmUrl();
  const Process simulator({Program("fleet-simulator"), "--scenario", "triangle", "--lcm-url", url});
  const Process controller({Program("formation-controller"), "--scenario", "triangle", "--lcm-url", url});
  const Finished all =
      RunToEnd({Program("skein"), "--lcm-url", url, "spy", "--for", "4", "--once", "--json"});
  ASSERT_EQ(all.exit_code, 0) << all.output;
  const json channels = json::parse(all.output)["channels"];
  const auto channel = [&](const std::string& name) {
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const json& entry) { return entry["channel"] == name; });
    return found == channels.end() ? json() : *found;
  };
  const json states = channel("FLEET_STATE");
  ASSERT_FALSE(states.is_null()) << all.output;
  EXPECT_EQ(states["type"], "fleet_state_t");
  EXPECT_EQ(states["undecodable"], 0);
  // Not that there are none: a simulator on a machine that is busy may leave a tick out.
  EXPECT_TRUE(states["gaps"].is_number());
  EXPECT_GT(states["count"], 20);
  EXPECT_GT(states["bytes_per_s"], 0);
  EXPECT_TRUE(states["jitter_s"].is_number());
  EXPECT_EQ(channel("CMD_FLEET")["type"], "fleet_command_t");

  const Finished beat = RunToEnd({Program("skein"), "--lcm-url", url, "spy", "HEARTBEAT", "--once", "--where",
                                  "heartbeat_node=formation-controller"});
  EXPECT_EQ(beat.exit_code, 0) << beat.output;
  EXPECT_NE(beat.output.find("formation-controller"), std::string::npos) << beat.output;
  EXPECT_NE(beat.output.find("undecodable"), std::string::npos) << beat.output;
}

TEST(SkeinSpy, FailsWhenItsOutputCannotBeWritten) {
  const Finished ended = RunToEnd(
      {"bash", "-c", Program("skein") + " --lcm-url " + FreshLcmUrl() + " scenario list >/dev/full"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("could not be written"), std::string::npos) << ended.output;
}

TEST(SkeinSpy, SaysWhenNothingIsHeard) {
  const Finished spy =
      RunToEnd({Program("skein"), "--lcm-url", FreshLcmUrl(), "spy", "--for", "0.5", "--once"});
  EXPECT_EQ(spy.exit_code, 1);
  EXPECT_NE(spy.output.find("nothing was heard for 0.5 s"), std::string::npos) << spy.output;
}

}  // namespace
}  // namespace skein::testing

// What deploy/ ships, tried with the programs that it is for.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "system/bus_ear.h"
#include "system/process.h"

namespace skein::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path kDeploy = fs::path(SKEIN_SOURCE_DIR) / "deploy";
const std::vector<std::string> kPrograms{"fleet-simulator", "formation-controller", "collision-monitor",
                                         "web-bridge", "flight-recorder"};

std::string Content(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A file system as an installation leaves it, as far as systemd-analyze looks at it.
class UnitsTest : public ::testing::Test {
 protected:
  UnitsTest() {
    for (const char* folder : {"usr/bin", "usr/lib/systemd/system", "lib/systemd", "etc/systemd/system"})
      fs::create_directories(root_ / folder);
    for (const std::string& program : kPrograms) PutProgram("usr/bin/" + program);
    PutProgram("usr/bin/sh");
    PutProgram("lib/systemd/systemd-socket-proxyd");
    const fs::path systems = "/usr/lib/systemd/system";
    for (const auto& entry : fs::directory_iterator(systems)) {
      const std::string extension = entry.path().extension();
      if ((extension == ".target" || extension == ".slice") && entry.is_regular_file())
        fs::copy(entry.path(), root_ / "usr/lib/systemd/system");
    }
    for (const auto& entry : fs::directory_iterator(kDeploy / "systemd"))
      if (entry.path().extension() != ".env" && entry.is_regular_file()) fs::copy(entry.path(), Units());
  }
  ~UnitsTest() override { fs::remove_all(root_); }

  fs::path Units() const { return root_ / "etc/systemd/system"; }
  void PutProgram(const std::string& path) {
    std::ofstream(root_ / path) << "#!/bin/sh\n";
    fs::permissions(root_ / path, fs::perms::owner_all);
  }
  /// Into a network of their own, as deploy/README.md says.
  void MakeSingleHost() {
    const fs::path single = kDeploy / "systemd/single-host";
    const auto drop_in = [&](const std::string& unit, const char* file) {
      fs::create_directories(Units() / (unit + ".service.d"));
      fs::copy(single / file, Units() / (unit + ".service.d") / "single-host.conf");
    };
    drop_in("skein-bus", "skein-bus.conf");
    for (const std::string& program : kPrograms) drop_in("skein-" + program, "skein-node.conf");
    fs::copy(single / "skein-page.socket", Units());
    fs::copy(single / "skein-page.service", Units());
  }
  /// What systemd finds wrong with the units.
  std::string Problems() const {
    std::vector<std::string> command{"systemd-analyze", "verify", "--root=" + root_.string()};
    for (const auto& entry : fs::directory_iterator(Units()))
      if (entry.is_regular_file()) command.push_back(entry.path());
    const Finished verified = RunToEnd(command);
    return verified.output + (verified.exit_code == 0 ? "" : "(exit code not 0)");
  }

  fs::path root_ = FreshFolder("skein-units");
};

TEST_F(UnitsTest, AreAsSystemdWantsThem) { EXPECT_EQ(Problems(), ""); }

TEST_F(UnitsTest, AreSoInANetworkOfTheirOwn) {
  MakeSingleHost();
  EXPECT_EQ(Problems(), "");
}

TEST_F(UnitsTest, WouldBeFoundOutIfTheyWereNot) {
  std::ofstream(Units() / "skein-bus.service", std::ios::app) << "[Service]\nRestrat=always\n";
  EXPECT_NE(Problems().find("Restrat"), std::string::npos);
}

TEST_F(UnitsTest, GiveProgramsOptionsThatTheyHave) {
  for (const std::string& program : kPrograms) {
    const std::string unit = Content(Units() / ("skein-" + program + ".service"));
    const std::string help = RunToEnd({Program(program), "--help"}).output;
    std::smatch line;
    ASSERT_TRUE(std::regex_search(unit, line, std::regex("ExecStart=(\\S+) (.*)"))) << program;
    EXPECT_EQ(line[1], program);
    const std::string arguments = line[2];
    const std::regex option("--[a-z-]+");
    for (std::sregex_iterator it(arguments.begin(), arguments.end(), option), end; it != end; ++it)
      EXPECT_NE(help.find(it->str()), std::string::npos) << program << " " << it->str();
    EXPECT_NE(unit.find("Restart=always"), std::string::npos) << program;
  }
}

TEST_F(UnitsTest, HaveAFolderForTemporaryFilesInANetworkOfTheirOwn) {
  // Who joins another unit's network joins its /tmp, too.
  EXPECT_NE(Content(kDeploy / "systemd/single-host/skein-bus.conf").find("\nPrivateTmp=yes\n"),
            std::string::npos);
}

/// The shell's part of a line of skein-bus.service, as systemd would run it.
std::string BusScript(const std::string& key) {
  std::string unit = Content(kDeploy / "systemd/skein-bus.service");
  for (const auto& [from, to] : {std::pair("\\\n", ""), std::pair("$$", "$"), std::pair("%%", "%")}) {
    for (std::size_t at = 0; (at = unit.find(from, at)) != std::string::npos; at += std::string(to).size())
      unit.replace(at, std::string(from).size(), to);
  }
  const std::string begin = "\n" + key + "=sh -c '";
  const std::size_t start = unit.find(begin) + begin.size();
  return unit.substr(start, unit.find("'\n", start) - start);
}

TEST_F(UnitsTest, MakeARouteOverLoForABusThatStaysOnThisHostAndTakeItAway) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root";
  const std::string routes = "; ip -4 route show; echo -; ";
  const std::string script = "mount -t tmpfs none /run && ip link set lo up && (" + BusScript("ExecStart") +
                             ")" + routes + BusScript("ExecStop") + routes;
  const auto run = [&](const std::string& url) {
    return RunToEnd({"env", "LCM_DEFAULT_URL=" + url, "unshare", "--net", "--mount", "sh", "-ec", script})
        .output;
  };
  EXPECT_EQ(run("udpm://239.255.76.67:7667?ttl=0"), "239.255.76.67 dev lo scope link \n-\n-\n");
  EXPECT_EQ(run("udpm://239.255.9.9:7700"), "239.255.9.9 dev lo scope link \n-\n-\n") << "LCM's ttl is 0";
  EXPECT_EQ(run("udpm://239.255.76.67:7667?recv_buf_size=100000&ttl=0"),
            "239.255.76.67 dev lo scope link \n-\n-\n");
  EXPECT_EQ(run("udpm://239.255.76.67:7667?ttl=1"), "-\n-\n") << "others would find themselves on lo";
  EXPECT_EQ(run("tcpq://10.0.0.1:7700"), "-\n-\n");
}

/// Runs a script beside this file; skips the test when it says, with exit code 77, that it cannot be done
/// here.
void RunOrSkip(const std::vector<std::string>& command) {
  const Finished done = RunToEnd(command, 60s);
  if (done.exit_code == 77) GTEST_SKIP() << done.output;
  EXPECT_EQ(done.exit_code, 0) << done.output;
}

TEST(NftRule, LetsNamedHostsOnTheBusAlone) {
  RunOrSkip({"bash", std::string(SKEIN_SOURCE_DIR) + "/tests/system/nft_rule.sh",
             kDeploy / "nftables/skein.nft", Program("skein")});
}

TEST(TlsProxy, ServesThePageItsApiAndItsLiveLinkOnOnePort) {
  const fs::path folder = FreshFolder("skein-tls");
  const std::string tokens = folder / "tokens.json";
  const Finished token =
      RunToEnd({Program("skein"), "token", "new", "Ada", "--role", "operator", "--file", tokens});
  ASSERT_EQ(token.exit_code, 0) << token.output;
  const std::string port = std::to_string(FreeTcpPort());
  const std::string url = FreshLcmUrl();
  Process bridge({Program("web-bridge"), "--lcm-url", url, "--port", port, "--tokens", tokens, "--allow-host",
                  "ground.example.org"});
  ASSERT_TRUE(HearsHeartbeat(url, "web-bridge")) << bridge.output();
  RunOrSkip({"python3", std::string(SKEIN_SOURCE_DIR) + "/tests/system/tls_proxy.py",
             kDeploy / "nginx/skein.conf", folder, port, token.output.substr(0, token.output.find('\n'))});
  fs::remove_all(folder);
}

}  // namespace
}  // namespace skein::testing

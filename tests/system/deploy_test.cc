// What deploy/ ships, tried with the programs that it is for.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "system/bus_ear.h"
#include "system/process.h"
#include "system/text_files.h"

namespace skein::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path kDeploy = fs::path(SKEIN_SOURCE_DIR) / "deploy";
const std::vector<std::string> kPrograms{"fleet-simulator", "formation-controller", "collision-monitor",
                                         "web-bridge", "flight-recorder"};

/// A file system as an installation by deploy/README.md leaves it, as far as systemd-analyze looks at it.
class UnitsTest : public ::testing::Test {
 protected:
  UnitsTest() {
    for (const char* folder : {"usr/bin", "usr/lib/systemd/system", "lib/systemd", "etc/systemd/system"})
      fs::create_directories(root_ / folder);
    for (const std::string& program : kPrograms) PutProgram("usr/bin/" + program);
    PutProgram("usr/bin/sh");
    PutProgram("usr/bin/java");
    PutProgram("lib/systemd/systemd-socket-proxyd");
    const fs::path systems = "/usr/lib/systemd/system";
    for (const auto& entry : fs::directory_iterator(systems)) {
      const std::string extension = entry.path().extension();
      if ((extension == ".target" || extension == ".slice") && entry.is_regular_file())
        fs::copy(entry.path(), root_ / "usr/lib/systemd/system");
    }
    DoAsToldIn("README.md", "useradd --system skein\n");
  }
  ~UnitsTest() override { fs::remove_all(root_); }

  fs::path Units() const { return root_ / "etc/systemd/system"; }
  void PutProgram(const std::string& path) {
    std::ofstream(root_ / path) << "#!/bin/sh\n";
    fs::permissions(root_ / path, fs::perms::owner_all);
  }
  /// Types what a README in deploy/ says in the block that holds `word`, but for what needs a running
  /// systemd.
  void DoAsToldIn(const std::string& readme, const std::string& word) {
    for (const std::string& block : IndentedBlocks(Content(kDeploy / readme))) {
      if (block.find(word) == std::string::npos) continue;
      const Finished done =
          RunToEnd({"sh", "-ec",
                    "cd " SKEIN_SOURCE_DIR "; useradd() { :; }; systemctl() { :; }; nsenter() { :; }\n" +
                        std::regex_replace(block, std::regex("/etc/"), root_.string() + "/etc/")});
      ASSERT_EQ(done.exit_code, 0) << done.output;
      return;
    }
    FAIL() << "no such block: " << word;
  }
  void MakeSingleHost() { DoAsToldIn("README.md", "cd deploy/systemd/single-host\n"); }
  /// How much of the host a service may touch, of 100, by systemd's count.
  int Exposure(const std::string& service) const {
    const std::string said =
        RunToEnd({"systemd-analyze", "security", "--offline=true", "--root=" + root_.string(), service})
            .output;
    std::smatch found;
    const bool is_there =
        std::regex_search(said, found, std::regex("exposure level for \\S+: (\\d+)\\.(\\d)"));
    EXPECT_TRUE(is_there) << said;
    return is_there ? std::stoi(found[1].str() + found[2].str()) : 100;
  }
  std::vector<std::string> Services() const {
    std::vector<std::string> services;
    for (const auto& entry : fs::directory_iterator(Units()))
      if (entry.path().extension() == ".service") services.push_back(entry.path().filename());
    return services;
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

TEST_F(UnitsTest, LeaveEachServiceLittleThatItDoesNotNeed) {
  const auto check = [&](std::size_t count) {
    EXPECT_EQ(Services().size(), count);
    // The one that makes a route is root, if with this right alone.
    for (const std::string& service : Services())
      EXPECT_LE(Exposure(service), service == "skein-bus.service" ? 21 : 14) << service;
  };
  check(kPrograms.size() + 1);
  MakeSingleHost();
  check(kPrograms.size() + 2);
}

TEST_F(UnitsTest, IncludeOneOfLcmsHubThatIsAsGood) {
  DoAsToldIn("wireguard/README.md", "lcm-hub.service");
  EXPECT_EQ(Problems(), "");
  EXPECT_LE(Exposure("lcm-hub.service"), 14);
  const Finished enabled = RunToEnd({"systemctl", "--root=" + root_.string(), "enable", "lcm-hub"});
  EXPECT_TRUE(fs::is_symlink(Units() / "multi-user.target.wants/lcm-hub.service"))
      << "would not start with the host: " << enabled.output;
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
  for (const auto& [from, to] :
       {std::pair("\\\n", ""), std::pair("$$", "$"), std::pair("%t", "/run"), std::pair("%%", "%")}) {
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
  const std::string script = "mount -t tmpfs none /run && mkdir /run/skein-bus && ip link set lo up && (" +
                             BusScript("ExecStart") + ")" + routes + BusScript("ExecStop") + routes;
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

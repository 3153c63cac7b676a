// The example of deploy/wireguard/README.md as it stands there: a bus over WireGuard, and who is kept off it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <skein/formation_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/hosts.h"
#include "system/process.h"
#include "system/text_files.h"

namespace skein::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const std::string kLcmJar = "/usr/share/java/lcm.jar";
const std::string kGroundOutside = "10.78.0.1";
const std::string kGroundInTunnel = "10.76.67.1";

/// The configuration of a tunnel with the words in brackets filled in.
std::string FilledIn(std::string config, const std::map<std::string, std::string>& values) {
  for (const auto& [key, value] : values)
    config = std::regex_replace(config, std::regex(key + " = .*"), key + " = " + value);
  return config;
}

class WireGuardTest : public ::testing::Test {
 protected:
  struct Keys {
    std::string secret;
    std::string open;
  };

  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "network namespaces need root";
    if (!fs::exists("/dev/net/tun")) GTEST_SKIP() << "no /dev/net/tun here";
    if (RunToEnd({"sh", "-c", "command -v wg-quick && command -v wireguard-go"}).exit_code != 0)
      GTEST_SKIP() << "no wg-quick or no wireguard-go here: scripts/setup test";
    ASSERT_TRUE(fs::exists(kLcmJar)) << "scripts/setup test";
    ASSERT_NO_FATAL_FAILURE(ReadReadme());
    hosts_ = std::make_unique<Hosts>(std::vector<std::string>{"ground", "fleet", "stranger"});
    ground_keys_ = MakeKeys("ground");
    const Keys fleet_keys = MakeKeys("fleet");
    const std::string ground_config =
        FilledIn(ground_config_, {{"PrivateKey", ground_keys_.secret}, {"PublicKey", fleet_keys.open}});
    ASSERT_NO_FATAL_FAILURE(RaiseTunnel("ground", ground_config));
    ASSERT_NO_FATAL_FAILURE(RaiseTunnel("fleet", OtherConfig(fleet_keys)));
    Start("ground", "hub", {"sh", "-c", "exec " + hub_command_});
    Start("ground", "web-bridge", {Program("web-bridge"), "--port", "8080"});
    ASSERT_TRUE(processes_["web-bridge"]->WaitForOutput("http://127.0.0.1:8080", 20s))
        << processes_["web-bridge"]->output() << processes_["hub"]->output();
    ASSERT_TRUE(ReachesHub("fleet", kGroundInTunnel))
        << "there is no tunnel: " << tunnels_["fleet"]->output();
  }
  void TearDown() override {
    processes_.clear();
    tunnels_.clear();
    hosts_.reset();
    fs::remove_all(folder_);
  }

  void ReadReadme() {
    const std::string readme = Content(fs::path(SKEIN_SOURCE_DIR) / "deploy/wireguard/README.md");
    const std::vector<std::string> blocks = IndentedBlocks(readme);
    ASSERT_EQ(blocks.size(), 5U) << "two configurations, hub and node, firewall, what a reboot needs";
    ground_config_ = blocks[0];
    other_config_ = std::regex_replace(blocks[1], std::regex("ground\\.example\\.org"), kGroundOutside);
    hub_rule_ = "cd " SKEIN_SOURCE_DIR "; " + blocks[3];
    std::smatch found;
    ASSERT_TRUE(std::regex_search(readme, found, std::regex("keys by `([^`]*)`")));
    keys_command_ = found[1];
    ASSERT_TRUE(std::regex_search(blocks[2], found, std::regex("(java .*)\nLCM_DEFAULT_URL=(\\S+) ")));
    hub_command_ = found[1];
    url_ = found[2];
  }
  Keys MakeKeys(const std::string& host) const {
    fs::create_directory(folder_ / host);
    const Finished made = RunToEnd({"sh", "-c", "cd " + (folder_ / host).string() + " && " + keys_command_});
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return {Content(folder_ / host / "key"), made.output};
  }
  /// Of a host other than the ground station.
  std::string OtherConfig(const Keys& keys) const {
    return FilledIn(other_config_, {{"PrivateKey", keys.secret}, {"PublicKey", ground_keys_.open}});
  }
  /// Network namespaces share files: where WireGuard keeps its own, this command sees those of its host.
  std::vector<std::string> WithFilesOf(const std::string& host, const std::string& command) const {
    const std::string files = folder_ / host;
    return {"unshare", "--mount", "sh", "-c",
            "mount --bind " + files + " /etc/wireguard && mount --bind " + files + " /run && " + command};
  }
  void RaiseTunnel(const std::string& host, const std::string& config) {
    std::ofstream(folder_ / host / "skein.conf") << config;
    const Hosts::Stay stay = hosts_->On(host);
    // Is kept because wireguard-go goes on in its group when wg-quick has ended.
    tunnels_[host] = std::make_unique<Process>(WithFilesOf(host, "wg-quick up skein"));
    ASSERT_EQ(tunnels_[host]->WaitForEnd(10s), 0) << tunnels_[host]->output();
  }

  void Start(const std::string& host, const std::string& name, const std::vector<std::string>& command) {
    const Hosts::Stay stay = hosts_->On(host);
    processes_[name] =
        std::make_unique<Process>(command, std::map<std::string, std::string>{{"LCM_DEFAULT_URL", url_}});
  }
  Finished From(const std::string& host, const std::vector<std::string>& command) const {
    const Hosts::Stay stay = hosts_->On(host);
    return RunToEnd(command);
  }
  bool ReachesHub(const std::string& host, const std::string& address) const {
    const std::string connect = "import socket, sys; socket.create_connection((sys.argv[1], 7700), 2)";
    return From(host, {"python3", "-c", connect, address}).exit_code == 0;
  }
  bool HearsItInFormation(const std::string& host) const {
    const Hosts::Stay stay = hosts_->On(host);
    return Hears<formation_status_t>(
        url_, bus::channel::kFormationStatus,
        [](const formation_status_t& status) { return status.mode == formation_status_t::MODE_IN_FORMATION; },
        20s);
  }

  fs::path folder_ = FreshFolder("skein-wireguard");
  std::string keys_command_, ground_config_, other_config_, hub_command_, url_, hub_rule_;
  Keys ground_keys_;
  std::unique_ptr<Hosts> hosts_;
  std::map<std::string, std::unique_ptr<Process>> tunnels_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
};

TEST_F(WireGuardTest, CarriesAFlightAndIsTheOnlyWayToTheHub) {
  Start("fleet", "fleet-simulator", {Program("fleet-simulator"), "--scenario", "turn"});
  for (const std::string node : {"formation-controller", "collision-monitor"})
    Start("ground", node, {Program(node), "--scenario", "turn"});
  hosts_->Ip("stranger", {"route", "add", kGroundInTunnel, "via", kGroundOutside});
  for (const std::string& address : {kGroundOutside, kGroundInTunnel})
    EXPECT_TRUE(ReachesHub("stranger", address))
        << address << ": it would not be the rule that keeps him out";

  const Finished rule = From("ground", {"sh", "-ec", hub_rule_});
  ASSERT_EQ(rule.exit_code, 0) << rule.output;
  for (const std::string& address : {kGroundOutside, kGroundInTunnel})
    EXPECT_FALSE(ReachesHub("stranger", address)) << address;

  // LCM waits for minutes where nothing answers.
  for (const char* host : {"ground", "fleet"})
    ASSERT_TRUE(ReachesHub(host, kGroundInTunnel)) << "the rule keeps out " << host;
  EXPECT_TRUE(HearsItInFormation("fleet"))
      << processes_["formation-controller"]->output() << processes_["fleet-simulator"]->output();
  {
    const Hosts::Stay stay = hosts_->On("fleet");
    EXPECT_TRUE(HearsHeartbeat(url_, "collision-monitor")) << processes_["collision-monitor"]->output();
  }
  const Finished hold = From("fleet", {Program("skein"), "--lcm-url", url_, "formation", "hold", "1"});
  EXPECT_EQ(hold.exit_code, 0) << "the controller on the ground does not answer: " << hold.output;
  const Finished cut =
      From("ground", {Program("skein"), "--lcm-url", url_, "link", "cut", "3", "--for", "1"});
  EXPECT_EQ(cut.exit_code, 0) << "the simulator on the other host does not answer: " << cut.output;
  const Finished page =
      From("ground", {"python3", "-c",
                      "import urllib.request; "
                      "print(urllib.request.urlopen('http://127.0.0.1:8080/api/vehicles').read().decode())"});
  EXPECT_NE(page.output.find("UAV3"), std::string::npos) << page.output;
}

TEST_F(WireGuardTest, KeepsOutWhoHasAnotherKey) {
  ASSERT_NO_FATAL_FAILURE(RaiseTunnel("stranger", OtherConfig(MakeKeys("stranger"))));
  EXPECT_FALSE(ReachesHub("stranger", kGroundInTunnel));
  const Finished transfer = From("stranger", WithFilesOf("stranger", "wg show skein transfer"));
  EXPECT_TRUE(std::regex_search(transfer.output, std::regex("\t0\t[1-9][0-9]*\n")))
      << "he is to send, and to receive nothing: " << transfer.output;
}

}  // namespace
}  // namespace skein::testing

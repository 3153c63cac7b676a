// A bus over TCP, across routed subnets without multicast: LCM's own hub, killed and started again in flight.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <skein/formation_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/hub.h"
#include "system/bus_ear.h"
#include "system/hosts.h"
#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

const std::string kHubUrl = "tcpq://10.79.2.2:7700";
const std::string kLcmJar = "/usr/share/java/lcm.jar";

class HubTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "network namespaces need root";
    ASSERT_TRUE(std::filesystem::exists(kLcmJar)) << "scripts/setup test";
    hosts_ = std::make_unique<Hosts>(std::vector<std::string>{"router", "sim", "station", "operator"});
    int subnet = 0;
    for (const char* host : {"sim", "station", "operator"}) {
      const std::string net = "10.79." + std::to_string(++subnet);
      hosts_->Ip("router", {"address", "add", net + ".1/24", "dev", "eth0"});
      hosts_->Ip(host, {"address", "flush", "dev", "eth0", "scope", "global"});
      hosts_->Ip(host, {"address", "add", net + ".2/24", "dev", "eth0"});
      hosts_->Ip(host, {"route", "add", "default", "via", net + ".1"});
    }
    const Hosts::Stay stay = hosts_->On("router");
    ASSERT_EQ(RunToEnd({"sh", "-c", "echo 1 > /proc/sys/net/ipv4/ip_forward"}).exit_code, 0);
  }
  void TearDown() override {
    nodes_.clear();
    hub_.reset();
    std::filesystem::remove_all(folder_);
  }

  void StartHub() {
    const Hosts::Stay stay = hosts_->On("station");
    hub_ = std::make_unique<Process>(
        std::vector<std::string>{"java", "-cp", kLcmJar, "lcm.lcm.TCPService", "7700"});
    ASSERT_TRUE(bus::AwaitHub(kHubUrl));
  }
  /// Is started again when it ends, as systemd and scripts/run do it.
  void Keep(const std::string& host, const std::string& command) {
    const Hosts::Stay stay = hosts_->On(host);
    const std::string program = command.substr(0, command.find(' '));
    nodes_[program] = std::make_unique<Process>(
        std::vector<std::string>{"sh", "-c",
                                 "while :; do " + Program(program) + command.substr(program.size()) +
                                     " --lcm-url " + kHubUrl + "; sleep 0.2; done"});
  }
  bool HearsFormation(std::int8_t mode, Seconds timeout) const {
    const Hosts::Stay stay = hosts_->On("operator");
    return Hears<formation_status_t>(
        kHubUrl, bus::channel::kFormationStatus,
        [&](const formation_status_t& status) { return status.mode == mode; }, timeout);
  }
  Finished FromTheOperator(const std::vector<std::string>& command) const {
    const Hosts::Stay stay = hosts_->On("operator");
    return RunToEnd(command);
  }
  Finished Formation(const std::string& what) const {
    return FromTheOperator({Program("skein"), "--lcm-url", kHubUrl, "formation", what, "1"});
  }

  std::string folder_ = FreshFolder("skein-hub");
  std::unique_ptr<Hosts> hosts_;
  std::unique_ptr<Process> hub_;
  std::map<std::string, std::unique_ptr<Process>> nodes_;
};

TEST_F(HubTest, CarriesAFlightOverSubnetsAndMayBeKilledAndStartedAgain) {
  // Nodes that are there before the hub wait for it.
  for (const std::string node : {"formation-controller", "collision-monitor"})
    Keep("station", node + " --scenario turn --state-file " + folder_ + "/" + node);
  ASSERT_TRUE(nodes_["formation-controller"]->WaitForOutput("waits for it", 10s))
      << nodes_["formation-controller"]->output();
  StartHub();
  Keep("sim", "fleet-simulator --scenario turn --state-file " + folder_ + "/fleet-simulator");
  Keep("operator", "web-bridge --port 8080");
  ASSERT_TRUE(nodes_["web-bridge"]->WaitForOutput("http://127.0.0.1:8080", 20s))
      << nodes_["web-bridge"]->output();
  ASSERT_TRUE(HearsFormation(formation_status_t::MODE_IN_FORMATION, 60s))
      << nodes_["formation-controller"]->output();
  const Finished hold = Formation("hold");
  EXPECT_EQ(hold.exit_code, 0) << hold.output;

  hub_->Signal(SIGKILL);
  ASSERT_TRUE(hub_->WaitForEnd(5s));
  ASSERT_TRUE(nodes_["collision-monitor"]->WaitForOutput("waits for it", 10s))
      << nodes_["collision-monitor"]->output();
  EXPECT_EQ(Formation("resume").exit_code, 1) << "without a hub nothing can be commanded";
  StartHub();
  EXPECT_TRUE(HearsFormation(formation_status_t::MODE_HOLDING, 20s))
      << "what was commanded is forgotten: " << nodes_["formation-controller"]->output()
      << nodes_["fleet-simulator"]->output();
  const Finished resume = Formation("resume");
  EXPECT_EQ(resume.exit_code, 0) << resume.output;
  EXPECT_TRUE(HearsFormation(formation_status_t::MODE_IN_FORMATION, 60s));

  const Finished page = FromTheOperator(
      {"python3", "-c",
       "import urllib.request; "
       "print(urllib.request.urlopen('http://127.0.0.1:8080/api/vehicles').read().decode())"});
  EXPECT_NE(page.output.find("UAV3"), std::string::npos) << page.output;
}

}  // namespace
}  // namespace skein::testing

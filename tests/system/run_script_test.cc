// scripts/run as an operator uses it: everything starts, whatever dies comes back, nothing stays.

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <skein/heartbeat_t.hpp>
#include <skein/recording_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/flight_log.h"
#include "system/process.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kNodes{"fleet-simulator", "formation-controller", "collision-monitor",
                                      "web-bridge", "flight-recorder"};

std::string RunScript() { return std::string(SKEIN_SOURCE_DIR) + "/scripts/run"; }

/// scripts/run on ports of its own. Its bus URL tells its processes from all others.
class RunScriptTest : public ::testing::Test {
 protected:
  std::vector<std::string> Command(const std::string& scenario = "triangle") const {
    return {RunScript(), scenario, "--port", std::to_string(port_), "--lcm-url", url_};
  }
  std::string Address() const { return "http://127.0.0.1:" + std::to_string(port_); }

  /// The recording that the end of the script tells of.
  static std::string LogOf(const Process& run) {
    const std::size_t begin = run.output().find("logs/triangle-");
    if (begin == std::string::npos) return "none: " + run.output();
    const std::string log = run.output().substr(begin, run.output().find(".lcm", begin) + 4 - begin);
    return std::string(SKEIN_SOURCE_DIR) + "/" + log;
  }

  /// The running process of this flight with that name; 0 when there is none.
  pid_t Find(const std::string& program) const { return FindProcess(program, url_); }

  std::map<std::string, pid_t> All() const {
    std::map<std::string, pid_t> found{{"lcm-logger", Find("lcm-logger")}};
    for (const std::string& node : kNodes) found[node] = Find(node);
    return found;
  }

  /// Whether a later session than `since` of that node is heard.
  bool IsBack(const std::string& node, std::int64_t since_utime, Seconds timeout) const {
    return Hears<heartbeat_t>(
        url_, bus::channel::kHeartbeat,
        [&](const heartbeat_t& heartbeat) {
          return heartbeat.heartbeat_node == node && heartbeat.start_utime > since_utime;
        },
        timeout);
  }

  int port_ = FreeTcpPort();
  std::string url_ = FreshLcmUrl();
};

std::int64_t WallClock() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

TEST_F(RunScriptTest, StartsAllTellsTheAddressAndOnCtrlCEndsAllAndTellsTheLog) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  for (const auto& [name, process] : All()) EXPECT_NE(process, 0) << name;

  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
  EXPECT_EQ(ProcessesWith(url_).size(), 0U);
  EXPECT_GT(std::filesystem::file_size(LogOf(run)), 1000U);
}

TEST_F(RunScriptTest, EndsAllOnTermAndMindsNoImpatience) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  run.Signal(SIGTERM);
  run.Signal(SIGINT);
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
  EXPECT_EQ(run.output().find("Traceback"), std::string::npos) << run.output();
  EXPECT_EQ(ProcessesWith(url_).size(), 0U);
}

TEST_F(RunScriptTest, LeavesNothingRunningWhenItIsKilledItself) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  const std::vector<pid_t> all = ProcessesWith(url_);
  ASSERT_EQ(all.size(), kNodes.size() + 2);  // the recorder and itself
  run.Signal(SIGKILL);
  EXPECT_TRUE(WaitUntilGone(all, 5s));
}

TEST_F(RunScriptTest, BringsAKilledProcessBackWithinTwoSecondsWhileTheOthersGoOn) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  for (const std::string& victim : kNodes) {
    SCOPED_TRACE(victim);
    const auto before = All();
    const std::int64_t killed_utime = WallClock();
    kill(before.at(victim), SIGKILL);
    EXPECT_TRUE(IsBack(victim, killed_utime, 2s));
    EXPECT_TRUE(run.WaitForOutput(victim + " died (signal 9): started again", 1s)) << run.output();
    for (const auto& [name, process] : All()) {
      if (name == victim) continue;
      if (victim == "flight-recorder" && name == "lcm-logger") continue;  // it ends with its recorder
      EXPECT_EQ(process, before.at(name)) << name;
    }
  }
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
}

TEST_F(RunScriptTest, GoesOnRecordingInASecondFileWhenTheLoggerWasKilled) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  kill(Find("lcm-logger"), SIGKILL);
  EXPECT_TRUE(Hears<recording_status_t>(
      url_, bus::channel::kRecording,
      [](const recording_status_t& status) {
        return status.state == recording_status_t::RECORDING && status.parts == 2;
      },
      2s));
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
  EXPECT_NE(run.output().find("MB in 2 files)"), std::string::npos) << run.output();
}

TEST_F(RunScriptTest, RecordsTheFlightFromItsFirstTick) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
  const FlightLog log = ReadFlightLog(LogOf(run));
  ASSERT_FALSE(log.curves.empty());
  for (const auto& [id, curve] : log.curves) EXPECT_EQ(curve.front().t_s, 0) << "UAV " << id;
}

TEST_F(RunScriptTest, StartsAProcessThatDiesOverAndOverAgainNowAndThen) {
  Process run(Command());
  ASSERT_TRUE(run.WaitForOutput(Address(), 60s)) << run.output();
  // Five short lives; the first one may have been long while the others were started.
  bool told = false;
  std::int64_t killed_utime = 0;
  for (int death = 1; death <= 6 && !told; ++death) {
    killed_utime = WallClock();
    kill(Find("collision-monitor"), SIGKILL);
    told = run.WaitForOutput("collision-monitor died 5 times", death < 5 ? 0s : 1s);
    ASSERT_TRUE(told || IsBack("collision-monitor", killed_utime, 5s)) << run.output();
  }
  EXPECT_TRUE(told) << run.output();
  EXPECT_EQ(Find("collision-monitor"), 0);
  EXPECT_TRUE(HearsHeartbeat(url_, "formation-controller"));
  EXPECT_TRUE(IsBack("collision-monitor", killed_utime, 10s)) << run.output();
  run.Signal(SIGINT);
  EXPECT_EQ(run.WaitForEnd(15s), 0) << run.output();
}

TEST_F(RunScriptTest, RefusesATakenPortAndLeavesNothingRunning) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port_));
  ASSERT_EQ(bind(listening, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(listening, 1), 0);

  const Finished run = RunToEnd(Command(), 60s);
  close(listening);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("port " + std::to_string(port_) + " is taken"), std::string::npos) << run.output;
  EXPECT_EQ(ProcessesWith(url_).size(), 0U);
}

TEST_F(RunScriptTest, SaysWhichProcessEndedAtItsStartAndWhyAndLeavesNothingRunning) {
  const std::string folder = FreshFolder("skein-run");
  std::ofstream(folder + "/bad.json") << R"({"name": "bad", "wings": 2})";
  const Finished run = RunToEnd(Command(folder + "/bad.json"), 60s);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("ended at its start (exit code 2)"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("/wings"), std::string::npos) << run.output;
  EXPECT_EQ(ProcessesWith(url_).size(), 0U);
  std::filesystem::remove_all(folder);
}

TEST_F(RunScriptTest, RefusesAnUnknownScenarioAndNamesThoseThatShip) {
  const Finished run = RunToEnd(Command("no-such-scenario"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.output.find("paper-link-drop"), std::string::npos) << run.output;
}

TEST_F(RunScriptTest, MakesTheMissingMulticastRouteAndTakesItBack) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, for a network of its own";
  std::string command;
  for (const std::string& word : Command()) command += "'" + word + "' ";
  // A host whose only interface is the loopback. The second wait is for the end, the first for the signal.
  Process host({"unshare", "--net", "bash", "-c",
                "ip link set lo up; " + command +
                    "& run=$!; trap 'kill $run' TERM; wait $run; wait $run; "
                    "ip route get 239.255.76.67 || echo route is gone"});
  ASSERT_TRUE(host.WaitForOutput(Address(), 60s)) << host.output();
  EXPECT_NE(host.output().find("added 239.255.76.67/32 on lo"), std::string::npos) << host.output();
  host.Signal(SIGTERM);
  EXPECT_EQ(host.WaitForEnd(15s), 0) << host.output();
  EXPECT_NE(host.output().find("taken back"), std::string::npos) << host.output();
  EXPECT_NE(host.output().find("route is gone"), std::string::npos) << host.output();
}

TEST_F(RunScriptTest, LeavesTheMulticastRouteToWhoeverStillNeedsIt) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, for a network of its own";
  // Two that need it, of which the one that added it ends first; then one that was killed with its route
  // there.
  const Finished host = RunToEnd({"unshare", "--net", "bash", "-c", R"(
ip link set lo up
program=$0
hold() { coproc route { exec "$program" 'udpm://239.255.76.67:7667?ttl=0'; }; read -r _ <&"${route[0]}"; }
there() { ip route get 239.255.76.67 >/dev/null 2>&1 && echo "$1: there" || echo "$1: gone"; }
hold; first=${route[1]} first_pid=$route_PID
{ hold; } 2>/dev/null; second=${route[1]} second_pid=$route_PID
exec {first}>&-; wait $first_pid; there 'first ended'
exec {second}>&-; wait $second_pid; there 'second ended'
{ hold; } 2>/dev/null; kill -9 $route_PID; wait; there 'killed'
{ hold; } 2>/dev/null; last=${route[1]} last_pid=$route_PID; exec {last}>&-; wait $last_pid; there 'next ended')",
                                  std::string(SKEIN_SOURCE_DIR) + "/scripts/lib/multicast_route.py"},
                                 20s);
  for (const char* state : {"first ended: there", "second ended: gone", "killed: there", "next ended: gone"})
    EXPECT_NE(host.output.find(state), std::string::npos) << state << " in:\n" << host.output;
}

}  // namespace
}  // namespace skein::testing

// Random and mutated datagrams at the port of a flight, slow and hostile clients at its page: nobody falls,
// and the formation is held.
//
// SKEIN_HOSTILE: how many (default: 20000; scripts/soak sends a million).

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <string>
#include <vector>

#include "system/faulty_flight.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

constexpr int kPerSecond = 2000;

class HostileTest : public FaultsTest {
 protected:
  static int Count() {
    const char* count = std::getenv("SKEIN_HOSTILE");
    return count != nullptr ? std::stoi(count) : 20'000;
  }
  struct Latency {
    double median_ms = 0;
    double latest_ms = 0;
  };
  /// From FLEET_STATE to the commands that answer it, until `running` ends or the time is up.
  Latency ControlLatency(Seconds duration, Process* running) const {
    const bus::Transport transport = bus::MakeTransport(url_);
    bus::LiveExecutor executor(transport.lcm);
    bus::Bus ear(transport.lcm, "system-test", executor);
    std::map<std::int64_t, bus::Utime> stated;
    std::vector<double> latencies_ms;
    ear.Subscribe<fleet_state_t>(bus::channel::kFleetState,
                                 [&](const fleet_state_t& state) { stated[state.tick] = executor.Now(); });
    ear.Subscribe<fleet_command_t>(bus::channel::kCmdFleet, [&](const fleet_command_t& command) {
      const auto found = stated.find(command.state_tick);
      if (found != stated.end()) latencies_ms.push_back(1e3 * bus::ToSeconds(executor.Now() - found->second));
    });
    executor.Every(bus::kSecond / 2, [&] {
      if (running != nullptr && running->WaitForEnd(0s)) executor.Stop();
    });
    executor.At(executor.Now() + bus::ToUtime(duration.count()), [&] { executor.Stop(); });
    executor.Run();
    std::ranges::sort(latencies_ms);
    if (latencies_ms.empty()) return {};
    return {latencies_ms[latencies_ms.size() / 2], latencies_ms.back()};
  }
  std::string Port() const {
    std::smatch found;
    return std::regex_search(url_, found, std::regex(":(\\d+)\\?")) ? found[1].str() : "";
  }
};

TEST_F(HostileTest, AFlightMindsNoDatagrams) {
  scenario_ = "turn";  // in formation from the start
  StartAll();
  ASSERT_TRUE(HoldsSlots(20, 30s));
  const std::string seed = std::to_string(std::random_device()());
  std::cout << "seed " << seed << "\n";
  Process hostile({SKEIN_SOURCE_DIR "/tests/system/hostile_datagrams.py", "239.255.76.67", Port(),
                   std::to_string(Count()), std::to_string(kPerSecond), seed});
  ASSERT_TRUE(hostile.WaitForEnd(Seconds(2.0 * Count() / kPerSecond + 20)));
  EXPECT_NE(hostile.output().find("datagrams in"), std::string::npos) << hostile.output();
  for (const std::string& node : kNodes) {
    EXPECT_EQ(nodes_[node]->WaitForEnd(0s), std::nullopt) << node << " has ended: " << nodes_[node]->output();
  }
  EXPECT_TRUE(HoldsSlots(20, 10s));
  // Told, and once for each channel, however many there were.
  for (const std::string& node : kNodes) {
    std::map<std::string, int> told;
    const std::string output = nodes_[node]->output();
    const std::regex refusal("message_refused: a message on (\\w+)");
    for (std::sregex_iterator found(output.begin(), output.end(), refusal), end; found != end; ++found)
      ++told[(*found)[1].str()];
    EXPECT_FALSE(told.empty()) << node << ": " << output;
    for (const auto& [channel, times] : told) EXPECT_EQ(times, 1) << node << ": " << channel;
  }
  std::cout << hostile.output();
}

TEST_F(HostileTest, AFlightMindsNoClientsOfItsPage) {
  scenario_ = "turn";
  StartAll();
  const std::string port = std::to_string(FreeTcpPort());
  Process bridge({Program("web-bridge"), "--lcm-url", url_, "--port", port});
  ASSERT_TRUE(bridge.WaitForOutput("http://127.0.0.1:" + port, 10s)) << bridge.output();
  Latency before = ControlLatency(3s, nullptr);
  Process clients(
      {SKEIN_SOURCE_DIR "/tests/system/hostile_clients.py", port, std::to_string(bridge.pid()), "15"});
  Latency during = ControlLatency(60s, &clients);
  ASSERT_EQ(clients.WaitForEnd(0s), 0) << clients.output();
  std::cout << clients.output() << "commands after their state, median and latest: " << before.median_ms
            << " and " << before.latest_ms << " ms before, " << during.median_ms << " and "
            << during.latest_ms << " ms meanwhile\n";
  const auto told = nlohmann::json::parse(clients.output());
  EXPECT_GT(told["answers"], 30) << "others are not served";
  EXPECT_EQ(told["refused"], 0) << "others are not served";
  EXPECT_LT(told["slowest_ms"], 3000);
  EXPECT_LT(told["memory_at_most_mb"], 200);
  EXPECT_EQ(bridge.WaitForEnd(0s), std::nullopt) << bridge.output();
  EXPECT_TRUE(HoldsSlots(20, 10s));
}

}  // namespace
}  // namespace skein::testing

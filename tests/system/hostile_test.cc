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
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "system/faulty_flight.h"
#include "unit/bridge/live_client.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;

constexpr int kPerSecond = 2000;

// Commands answer a state within its tick. One that is late still does no harm until a UAV has had none for 1
// s (then it may hold): half of that leaves room for a busy machine.
constexpr double kTick_ms = 50;
constexpr double kLatest_ms = 500;
// Ten frames a second come. The page flies UAVs on by itself for 2 s; so much nobody sees.
constexpr double kLongestGap_ms = 1000;
// What a person waits for at a page.
constexpr double kSlowest_ms = 1000;
// By the bridge's own limits these clients fill some 20 MB: 4 MiB for each of two that do not read what they
// ask for, 1 MiB for each of eight that send a message or a body, and 250 connections that hardly say
// anything.
constexpr double kGrowth_mb = 30;

class HostileTest : public FaultsTest {
 protected:
  static int Count() {
    const char* count = std::getenv("SKEIN_HOSTILE");
    return count != nullptr ? std::stoi(count) : 20'000;
  }
  struct Latency {
    double median_ms = 0;
    double latest_ms = 0;
    std::size_t states = 0;
    std::size_t unanswered = 0;
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
    const std::size_t answered = latencies_ms.size();
    if (answered == 0) return {.states = stated.size(), .unanswered = stated.size()};
    return {latencies_ms[answered / 2], latencies_ms.back(), stated.size(), stated.size() - answered};
  }
  std::string Port() const {
    std::smatch found;
    return std::regex_search(url_, found, std::regex(":(\\d+)\\?")) ? found[1].str() : "";
  }
};

/// A browser that behaves: reads all that comes, and notes for how long nothing did.
class Onlooker {
 public:
  explicit Onlooker(int port) : browser_(static_cast<std::uint16_t>(port)) {
    thread_ = std::jthread([this](const std::stop_token& stop) { Look(stop); });
  }

  struct Seen {
    int frames = 0;  ///< with motions
    double longest_gap_ms = 0;
    std::string problem;
  };
  Seen Stop() {
    thread_.request_stop();
    thread_.join();
    return seen_;
  }

 private:
  void Look(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    constexpr char kMotion = 1;
    auto last = Clock::now();
    const auto note_gap = [&] {
      const std::chrono::duration<double, std::milli> gap = Clock::now() - last;
      seen_.longest_gap_ms = std::max(seen_.longest_gap_ms, gap.count());
    };
    try {
      while (!stop.stop_requested()) {
        const auto message = browser_.Read();
        if (!message) throw std::runtime_error("the bridge has closed the connection");
        if (!message->binary || message->bytes.front() != kMotion) continue;
        note_gap();
        last = Clock::now();
        ++seen_.frames;
      }
    } catch (const std::runtime_error& error) {
      seen_.problem = error.what();
    }
    note_gap();
  }

  bridge::LiveClient browser_;
  Seen seen_;  ///< of the thread, until it has ended
  std::jthread thread_;
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
  // Told, and once for each channel and reason, however many there were.
  for (const std::string& node : kNodes) {
    std::map<std::string, int> told;
    const std::string output = nodes_[node]->output();
    const std::regex refusal("message_refused: a message on (\\w+ was refused: [^.]*)");
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
  Onlooker at_peace(std::stoi(port));
  const Latency before = ControlLatency(3s, nullptr);
  const Onlooker::Seen seen_before = at_peace.Stop();
  Onlooker onlooker(std::stoi(port));
  Process clients(
      {SKEIN_SOURCE_DIR "/tests/system/hostile_clients.py", port, std::to_string(bridge.pid()), "15"});
  const Latency during = ControlLatency(60s, &clients);
  const Onlooker::Seen seen = onlooker.Stop();
  ASSERT_EQ(clients.WaitForEnd(0s), 0) << clients.output();
  std::cout << clients.output() << "commands after their state, median and latest: " << before.median_ms
            << " and " << before.latest_ms << " ms before, " << during.median_ms << " and "
            << during.latest_ms << " ms meanwhile, " << during.unanswered << " of " << during.states
            << " states without commands\nlongest time without a frame at another browser: "
            << seen_before.longest_gap_ms << " ms before, " << seen.longest_gap_ms << " ms meanwhile, of "
            << seen.frames << "\n";

  EXPECT_GT(during.states, 15 * 20 / 2U);
  EXPECT_LE(during.unanswered, 2U) << "the last ones may be on their way";
  EXPECT_LT(during.median_ms, kTick_ms);
  EXPECT_LT(during.latest_ms, kLatest_ms);
  EXPECT_EQ(seen.problem, "");
  EXPECT_GT(seen.frames, 15 * 10 / 2);
  EXPECT_LT(seen.longest_gap_ms, kLongestGap_ms);
  const auto told = nlohmann::json::parse(clients.output());
  EXPECT_GT(told["answers"], 30) << "others are not served";
  EXPECT_GT(told["commands"], 5) << "others cannot command";
  EXPECT_EQ(told["refused"], 0) << "others are not served";
  EXPECT_LT(told["slowest_ms"], kSlowest_ms);
  EXPECT_LT(told["slowest_command_ms"], kSlowest_ms);
  EXPECT_LT(told["memory_at_most_mb"].get<double>() - told["memory_before_mb"].get<double>(), kGrowth_mb);
  EXPECT_EQ(bridge.WaitForEnd(0s), std::nullopt) << bridge.output();
  EXPECT_TRUE(HoldsSlots(20, 10s));
}

}  // namespace
}  // namespace skein::testing

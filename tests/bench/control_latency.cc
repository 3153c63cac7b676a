// How long after FLEET_STATE is sent the CMD_FLEET that answers it arrives, on a bus where a flight is under
// way, and how long a bare LCM ping-pong of messages as many and as large takes. tests/bench/README.md has
// the results. All times are the kernel's, of the datagram that ends a message, so that it does not matter
// when this process gets to read it.

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bus/channels.h"
#include "bus/transport.h"

namespace {

using namespace skein;  // NOLINT: a program of one file
using Clock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(50);
constexpr auto kStartUp = std::chrono::seconds(1);
constexpr int kSlowest_ms = 10;  // to look at the clock again

/// A message is as many datagrams as it has chunks, each of this size [B].
struct Shape {
  std::size_t chunks = 0;
  std::size_t bytes = 0;
};

/// Question and answer, by the tick that both name.
class Pairs {
 public:
  void Asked(std::int64_t tick, std::int64_t utime) { asked_[tick] = utime; }
  void Answered(std::int64_t tick, std::int64_t utime) {
    const auto asked = asked_.find(tick);
    if (asked == asked_.end()) return;
    took_ms_.push_back(1e-3 * static_cast<double>(utime - asked->second));
    asked_.erase(asked_.begin(), std::next(asked));
  }

  void Print(const char* what, Shape question, Shape answer) {
    std::sort(took_ms_.begin(), took_ms_.end());
    const auto quantile = [&](double part) {
      return took_ms_.empty() ? -1 : took_ms_[static_cast<std::size_t>(part * (took_ms_.size() - 1.0))];
    };
    std::printf("| %s | %zu x %zu B | %zu x %zu B | %zu | %.3f | %.3f | %.3f |\n", what, question.chunks,
                question.bytes, answer.chunks, answer.bytes, took_ms_.size(), quantile(0.5), quantile(0.99),
                quantile(1));
    std::fflush(stdout);
  }

 private:
  std::map<std::int64_t, std::int64_t> asked_;
  std::vector<double> took_ms_;
};

/// What is sent of a ping or a pong; the rest of its bytes is nothing.
struct Ball {
  std::int64_t tick;
  std::int32_t chunk;
  std::int32_t chunks;
};

void Serve(lcm::LCM& lcm, const char* channel, std::int64_t tick, Shape shape) {
  std::vector<char> bytes(std::max(shape.bytes, sizeof(Ball)));
  for (std::size_t i = 0; i < shape.chunks; ++i) {
    const Ball ball{tick, static_cast<std::int32_t>(i), static_cast<std::int32_t>(shape.chunks)};
    std::memcpy(bytes.data(), &ball, sizeof ball);
    lcm.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
  }
}

struct Ear {
  Pairs pairs;
  Shape question, answer;

  void HearState(const lcm::ReceiveBuffer* buffer, const std::string&, const fleet_state_t* state) {
    question = {static_cast<std::size_t>(state->chunk_count),
                std::max<std::size_t>(question.bytes, buffer->data_size)};
    if (state->chunk == state->chunk_count - 1) pairs.Asked(state->tick, buffer->recv_utime);
  }
  void HearCommand(const lcm::ReceiveBuffer* buffer, const std::string&, const fleet_command_t* command) {
    answer = {static_cast<std::size_t>(command->chunk_count),
              std::max<std::size_t>(answer.bytes, buffer->data_size)};
    if (command->chunk == command->chunk_count - 1) pairs.Answered(command->state_tick, buffer->recv_utime);
  }
  void HearPing(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Ball ball;
    std::memcpy(&ball, buffer->data, sizeof ball);
    if (ball.chunk == ball.chunks - 1) pairs.Asked(ball.tick, buffer->recv_utime);
  }
  void HearPong(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Ball ball;
    std::memcpy(&ball, buffer->data, sizeof ball);
    if (ball.chunk == ball.chunks - 1) pairs.Answered(ball.tick, buffer->recv_utime);
  }
};

/// Answers pings until it is ended.
struct Partner {
  lcm::LCM& lcm;
  Shape answer;

  void HearPing(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Ball ball;
    std::memcpy(&ball, buffer->data, sizeof ball);
    if (ball.chunk == ball.chunks - 1) Serve(lcm, "PONG", ball.tick, answer);
  }
};

void Listen(lcm::LCM& lcm, Clock::time_point until) {
  while (Clock::now() < until) lcm.handleTimeout(kSlowest_ms);
}

Ear HearFlight(const std::string& url, std::chrono::seconds how_long) {
  const auto lcm = bus::MakeTransport(url).lcm;
  Ear ear;
  lcm->subscribe(bus::channel::kFleetState, &Ear::HearState, &ear);
  lcm->subscribe(bus::channel::kCmdFleet, &Ear::HearCommand, &ear);
  Listen(*lcm, Clock::now() + how_long);
  return ear;
}

/// In processes of their own: one asks, one answers; this one listens, as it does to the flight.
Ear HearPingPong(const std::string& url, Shape question, Shape answer, std::chrono::seconds how_long) {
  const auto in_process = [](const auto& work) {
    const pid_t pid = fork();
    if (pid == 0) {
      work();
      _exit(0);
    }
    return pid;
  };
  const pid_t partner = in_process([&] {
    const auto lcm = bus::MakeTransport(url).lcm;
    Partner self{*lcm, answer};
    lcm->subscribe("PING", &Partner::HearPing, &self);
    while (lcm->handle() == 0) {
    }
  });
  const pid_t asking = in_process([&] {
    const auto lcm = bus::MakeTransport(url).lcm;
    std::this_thread::sleep_for(kStartUp);
    auto at = Clock::now();
    for (std::int64_t tick = 0;; ++tick) {
      Serve(*lcm, "PING", tick, question);
      std::this_thread::sleep_until(at += kTick);
    }
  });
  const auto lcm = bus::MakeTransport(url).lcm;
  Ear ear;
  lcm->subscribe("PING", &Ear::HearPing, &ear);
  lcm->subscribe("PONG", &Ear::HearPong, &ear);
  Listen(*lcm, Clock::now() + kStartUp + how_long);
  for (const pid_t pid : {partner, asking}) {
    kill(pid, SIGTERM);
    waitpid(pid, nullptr, 0);
  }
  ear.question = question;
  ear.answer = answer;
  return ear;
}

}  // namespace

int main(int argc, char** argv) {
  std::string url = bus::DefaultUrl();
  std::string ping_pong_url = "udpm://239.255.76.67:7699?ttl=0";
  int seconds = 20;
  CLI::App app(
      "How long a flight's commands take after its states, beside a bare LCM ping-pong of the same sizes");
  app.add_option("--lcm-url", url, "where a flight is under way")->capture_default_str();
  app.add_option("--ping-pong-url", ping_pong_url, "where nothing else is")->capture_default_str();
  app.add_option("--seconds", seconds, "for each")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  Ear flight = HearFlight(url, std::chrono::seconds(seconds));
  if (flight.answer.chunks == 0) {
    std::fprintf(stderr, "control-latency: no CMD_FLEET on %s in %d s\n", url.c_str(), seconds);
    return 1;
  }
  Ear bare = HearPingPong(ping_pong_url, flight.question, flight.answer, std::chrono::seconds(seconds));
  std::printf(
      "| what | question | answer | pairs | median, ms | p99, ms | worst, ms "
      "|\n|---|---|---|---|---|---|---|\n");
  flight.pairs.Print("FLEET_STATE to CMD_FLEET", flight.question, flight.answer);
  bare.pairs.Print("bare LCM ping-pong", bare.question, bare.answer);
}

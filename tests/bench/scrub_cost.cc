// What opening and scrubbing a recording costs: time to index it, to open it again, to jump; and memory.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "playback/open_recording.h"
#include "playback/player.h"
#include "recording/index_file.h"
#include "recording/recording.h"

namespace {

namespace fs = std::filesystem;
using skein::playback::OpenRecording;
using skein::playback::Player;

constexpr int kJumps = 200;
constexpr unsigned kSeed = 1;

/// What the clock on the wall says, and what this thread needed of a processor: on a busy machine only the
/// latter can be compared.
struct Cost {
  double wall_ms = 0;
  double cpu_ms = 0;
};

double Cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

template <typename Action>
Cost Measure(Action action) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start_ms = Cpu_ms();
  action();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
          Cpu_ms() - cpu_start_ms};
}

/// "VmRSS" or "VmHWM" of this process [MB].
double Memory_MB(const std::string& which) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == which + ":" && status >> kilobytes) return kilobytes / 1024;
  }
  return 0;
}

void Print(const char* what, Cost cost) {
  std::printf("%s: %.0f ms, of a processor %.0f ms\n", what, cost.wall_ms, cost.cpu_ms);
}

void Print(const char* what, std::vector<Cost> costs) {
  const auto print = [&](const char* of, double Cost::*part) {
    std::ranges::sort(costs, {}, part);
    std::printf("%s%s: median %.1f ms, p95 %.1f ms, worst %.1f ms\n", what, of, costs[costs.size() / 2].*part,
                costs[costs.size() * 95 / 100].*part, costs.back().*part);
  };
  print("", &Cost::wall_ms);
  print(", of a processor", &Cost::cpu_ms);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "scrub-cost FILE: a recording; its index is made anew\n");
    return 2;
  }
  const auto parts = skein::recording::PartsOf(argv[1]);
  for (const fs::path& part : parts) fs::remove(skein::recording::IndexFileOf(part));
  const auto go_on = [](double) { return true; };

  std::shared_ptr<const skein::playback::RecordedFlight> flight;
  Print("indexed and opened", Measure([&] { flight = OpenRecording(parts, go_on); }));
  flight.reset();
  Print("opened with its index", Measure([&] { flight = OpenRecording(parts, go_on); }));
  std::uintmax_t index_bytes = 0;
  for (const fs::path& part : parts) index_bytes += fs::file_size(skein::recording::IndexFileOf(part));
  std::printf("%.0f s; the index has %.1f MB\n", flight->duration_s(),
              static_cast<double>(index_bytes) / 1e6);

  std::size_t bytes = 0;
  Player player(flight, {}, [&](const skein::bridge::LiveFrame& frame) { bytes += frame.bytes->size(); });
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> anywhere(0, flight->duration_s());
  std::vector<Cost> jumps;
  bytes = 0;
  for (int i = 0; i < kJumps; ++i) {
    const double t_s = anywhere(random);
    jumps.push_back(Measure([&] { player.Seek(t_s); }));
  }
  Print("jumps", jumps);
  std::printf("a picture has %.0f kB; jumps with seed %u\n", static_cast<double>(bytes) / kJumps / 1e3,
              kSeed);
  for (const double speed : {1., 10., 50.}) {
    player.Seek(0);
    player.SetSpeed(speed);
    player.Play();
    std::vector<Cost> steps;
    for (int i = 0; i < 100 && player.playing(); ++i) {
      steps.push_back(Measure([&] { player.Advance(Player::kPeriod_s); }));
    }
    Print(("50 ms of playing at " + std::to_string(static_cast<int>(speed)) + " times").c_str(), steps);
    player.Pause();
  }
  std::printf("memory: %.0f MB, at most %.0f MB\n", Memory_MB("VmRSS"), Memory_MB("VmHWM"));
}

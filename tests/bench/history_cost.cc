// What web-bridge's history costs: memory after an hour of flight, and the time to take and to give samples.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "bridge/history_answer.h"

namespace {

using skein::bridge::EncodeHistory;
using skein::bridge::HistoryQuery;
using skein::recording::FleetTable;
using skein::recording::History;

constexpr int kFlight_s = 3600;
constexpr skein::bus::Utime kNow = 1'000'000'000;

template <typename Action>
double Milliseconds(Action action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::size_t HeapBytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

void Measure(int vehicles) {
  FleetTable fleet;
  skein::fleet_state_t state{};
  for (int id = 1; id <= vehicles; ++id) {
    skein::vehicle_state_t vehicle{};
    vehicle.id = id;
    state.vehicles.push_back(vehicle);
  }
  fleet.Take(state, kNow);

  const std::size_t before = HeapBytes();
  History history;
  double sum_ms = 0;
  double worst_ms = 0;
  for (int t_s = 0; t_s < kFlight_s; ++t_s) {
    const double took_ms = Milliseconds([&] { history.Take(fleet, double(t_s), kNow); });
    sum_ms += took_ms;
    worst_ms = std::max(worst_ms, took_ms);
  }
  std::printf("%5d UAVs: %.0f MB, spacing %g s; a sample %.3f ms, worst %.1f ms", vehicles,
              static_cast<double>(HeapBytes() - before) / 1e6, history.spacing_s(), sum_ms / kFlight_s,
              worst_ms);
  for (const int asked : {8, 32}) {
    HistoryQuery query;
    for (int id = 1; id <= asked; ++id) query.ids.push_back(id);
    std::string bytes;
    const double took_ms = Milliseconds([&] { bytes = EncodeHistory(history.samples(), query, 1); });
    std::printf("; %d of them %.1f ms, %.1f MB", asked, took_ms, static_cast<double>(bytes.size()) / 1e6);
  }
  std::printf("\n");
}

}  // namespace

int main() {
  for (const int vehicles : {100, 1000, 5000}) Measure(vehicles);
}

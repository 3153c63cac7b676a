#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "recording/fleet_table.h"

namespace skein::recording {

/// One UAV at one moment, as the charts draw it.
struct HistoryRow {
  static constexpr std::uint8_t kHeard = 1;  ///< altitude, speed and course are news, not what was heard last
  static constexpr std::uint8_t kHasSlot = 2;  ///< it has slot errors

  std::int32_t id = 0;
  /// In this order: up [m], speed [m/s], course (-pi..pi, counter-clockwise from east) [rad], forward, left
  /// and up error [m], distance to the nearest, horizontal and vertical [m] (-1 none), least Tau [s] (-1
  /// none).
  std::array<float, 9> values{0, 0, 0, 0, 0, 0, -1, -1, -1};
  std::uint8_t flags = 0;
};

/// The fleet at one moment. It never changes, so any thread may read it.
struct HistorySample {
  double t_s = 0;                ///< since the scenario's start
  std::vector<HistoryRow> rows;  ///< in order of id
};
using HistorySamples = std::vector<std::shared_ptr<const HistorySample>>;

/// The flight since the scenario's start, for a browser that comes late. A sample a second at first; when
/// there are too many, every second one goes and they come half as often from then on. So memory is bounded,
/// and a curve always begins at the start. What is shorter than the spacing may be missed.
class History {
 public:
  struct Limits {
    std::size_t samples = 7'200;   ///< two hours at one a second
    std::size_t rows = 2'000'000;  ///< over all samples; 44 B each
  };

  History() : History(Limits{}) {}
  explicit History(Limits limits) : limits_(limits) {}

  /// Takes a sample when one is due. @param t_s since the scenario's start, less than 0: not known. Time that
  /// runs backwards begins another flight.
  void Take(const FleetTable& fleet, double t_s, bus::Utime now);
  void Clear();

  const HistorySamples& samples() const { return samples_; }
  double spacing_s() const { return spacing_s_; }

 private:
  void ThinOut();

  Limits limits_;
  HistorySamples samples_;
  std::size_t row_count_ = 0;
  double spacing_s_ = 1;
};

}  // namespace skein::recording

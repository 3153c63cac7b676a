#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace skein::cli {

/// A data link that is to be cut, or made worse, for a time.
struct Drop {
  double at_s = 0;      ///< since the plan's beginning
  std::string vehicle;  ///< id or callsign, "all", or "none": nobody's link is to suffer (for hooks)
  bool uplink = true;
  bool downlink = true;
  double for_s = 35;
  double loss = 1;     ///< below 1: the link is up, but bad
  double delay_s = 0;  ///< of a link that is up

  bool is_cut() const { return loss >= 1; }
};

/// "up", "down", "both". Throws config::ConfigError for another, with `place`.
void SetDirection(Drop& drop, const std::string& direction, const std::string& place);
std::string Direction(const Drop& drop);
/// "cut upwards", "made worse both ways (20% loss, 0.3 s delay)".
std::string Words(const Drop& drop);

/// Drops from a file, in order of time: CSV with a heading line or JSON, an array of objects, both with at_s,
/// uav, for_s and, where wanted, direction, loss and delay_s. With a delay and no loss given, loss is 0.
/// Throws config::ConfigError with the place of what is wrong.
std::vector<Drop> ReadDrops(const std::filesystem::path& file);

/// As ReadDrops reads them again, with every column.
std::string DropsAsCsv(const std::vector<Drop>& drops);

struct RandomDrops {
  std::uint64_t seed = 1;
  double per_minute = 6;  ///< of the whole fleet, on average
  double shortest_s = 10;
  double longest_s = 40;
  std::string direction = "any";  ///< "any": drawn, too
};

/// Drops without end, the same for the same seed and fleet: gaps drawn exponentially, UAVs and durations
/// uniformly. Never two of one UAV at once, nor within kRestS after one: the monitor is to see the link up in
/// between.
class RandomPlan {
 public:
  static constexpr double kRestS = 10;

  RandomPlan(const RandomDrops& options, std::vector<int> vehicles);
  Drop Next();

 private:
  double Share();  ///< uniform, 0 <= share < 1, the same on every library

  RandomDrops options_;
  std::vector<int> vehicles_;
  std::vector<double> free_at_s_;  ///< as vehicles_
  std::mt19937_64 random_;
  double now_s_ = 0;
};

}  // namespace skein::cli

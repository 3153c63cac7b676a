#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/summary.h"

namespace skein::experiment {

/// What is measured of every run of a campaign, a column each. README.md says what they mean.
struct Metric {
  const char* column;
  const char* title;
  int decimals;
};
inline constexpr std::array<Metric, 21> kMetrics{{
    {"duration_s", "Duration [s]", 2},
    {"vehicles", "UAVs", 0},
    {"settled_s", "Settled in all slots [s]", 2},
    {"settled_forward_s", "  forward [s]", 2},
    {"settled_left_s", "  left [s]", 2},
    {"settled_up_s", "  up [s]", 2},
    {"settled_speed_s", "  speed [s]", 2},
    {"farthest_m", "Farthest from slot [m]", 1},
    {"least_distance_m", "Least distance [m]", 1},
    {"least_distance_at_s", "  at [s]", 2},
    {"cuts", "Cuts of links", 0},
    {"found", "  found", 0},
    {"missed", "  missed", 0},
    {"late", "  found after 5 s", 0},
    {"detection_median_s", "Detection, median of a run [s]", 2},
    {"detection_worst_s", "Detection, worst of a run [s]", 2},
    {"rejoined_worst_s", "In slot after link's return [s]", 2},
    {"lost_without_cut", "Lost without a cut", 0},
    {"advisories", "Advisories", 0},
    {"cautions", "Cautions", 0},
    {"warnings", "Warnings", 0},
}};

/// One run of a campaign.
struct CampaignRow {
  std::uint64_t seed = 0;
  std::string scenario;
  std::string control;
  std::array<std::optional<double>, kMetrics.size()> values;  ///< as kMetrics

  const std::optional<double>& Value(std::string_view column) const;
};

/// A cut is to be found within this; one that is over before does not count as missed.
inline constexpr double kDetectionLimitS = 5;

/// Numbers are rounded as the CSV has them, so that it makes no difference whether they have been in a file.
CampaignRow RowOf(std::uint64_t seed, const Summary& summary);

/// "seed,scenario,control,...", without the end of the line.
std::string CampaignHeader();
std::string ToCsv(const CampaignRow& row);

struct CampaignTable {
  std::vector<CampaignRow> rows;      ///< by seed, each once
  std::vector<std::string> warnings;  ///< of what was left out
};

/// What several campaigns over one scenario have flown, as if it had been one. A last line that is not whole
/// (of a program that was killed) is left out with a warning. Throws config::ConfigError with the place for a
/// file that cannot be read or is no campaign's, for another scenario or control, and for one seed with two
/// different rows.
CampaignTable MergeCampaigns(const std::vector<std::filesystem::path>& files);

}  // namespace skein::experiment

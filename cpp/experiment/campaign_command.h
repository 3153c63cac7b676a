#pragma once

#include <filesystem>
#include <vector>

#include "experiment/campaign.h"

namespace skein::experiment {

struct Campaign {
  CampaignOptions options;    ///< without on_row and on_progress
  std::filesystem::path csv;  ///< a row a run; "" for none
  std::filesystem::path plot;
};

/// Flies a campaign, writes its files as it goes, prints its summary. Returns the exit code; throws
/// config::ConfigError and std::runtime_error.
int Fly(const config::Scenario& scenario, const Campaign& campaign);

/// The parts of a campaign as one: sorted rows to `csv`, the figure to `plot` ("" for none), and its summary.
int Merge(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& csv,
          const std::filesystem::path& plot);

}  // namespace skein::experiment

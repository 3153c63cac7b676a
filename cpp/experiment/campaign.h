#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "config/scenario.h"
#include "experiment/campaign_row.h"

namespace skein::experiment {

struct CampaignOptions {
  std::uint64_t runs = 1;
  std::uint64_t first_seed = 1;
  unsigned jobs = 1;                 ///< runs at once, a thread each
  std::optional<double> duration_s;  ///< the scenario's own when empty
  bool logs = true;                  ///< whether events go into this process's log
  /// Asked by all threads at any time; true ends the campaign early.
  std::function<bool()> stop;
  /// Called for each run that was flown to its end, in the order of seeds, by one thread at a time. After a
  /// stop the rows that wait for an earlier seed come, too.
  std::function<void(const CampaignRow&)> on_row;
  /// Called after each run, by one thread at a time.
  std::function<void(std::uint64_t flown)> on_progress;
};

/// Flies the variations of seeds first_seed, first_seed + 1, ... (config::Varied; the seed is that of the
/// links' losses and jitter, too). Each run depends on its seed alone: not on how many there are, nor how
/// many at once. Throws std::runtime_error, with the seed, when a run cannot be flown; rows before it have
/// come then.
void FlyCampaign(const config::Scenario& scenario, const CampaignOptions& options);

}  // namespace skein::experiment

#pragma once

#include <string>
#include <vector>

#include "experiment/campaign_row.h"

namespace skein::experiment {

/// Quantiles of all metrics as text for people, with the seeds of the extremes. The same for the same rows,
/// whoever flew them.
std::string ToText(const std::vector<CampaignRow>& rows);

/// An SVG figure of how the runs are spread: the share of runs up to a value, for the metrics that matter.
std::string CampaignSvg(const std::vector<CampaignRow>& rows);

}  // namespace skein::experiment

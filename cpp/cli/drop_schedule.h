#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bus/executor.h"
#include "cli/drop_plan.h"
#include "cli/drops.h"
#include "cli/station.h"

namespace skein::cli {

/// The drops of a run in order of time, and when their times begin.
struct DropSchedule {
  bus::Utime base = 0;
  std::function<std::optional<Drop>()> next;  ///< none after the last

  bus::Utime StartOf(const Drop& drop) const { return base + bus::ToUtime(drop.at_s); }
};

/// @param lead so long commands go ahead of their time. Throws Failure for UAVs that there are not and a time
/// of the scenario that has passed, config::ConfigError for a list that cannot be used.
DropSchedule MakeSchedule(Station& station, const DropsOptions& options, bus::Utime lead);

/// Whose links a drop hits; nobody's with "none", which is for hooks.
std::vector<int> VehiclesOf(Station& station, const Drop& drop, const DropsOptions& options);

}  // namespace skein::cli

#pragma once

#include <string>
#include <vector>

#include "cli/station.h"

namespace skein::cli {

/// Identifiers of UAVs that are named by id or callsign (case does not matter). Asks for the roster only when
/// it takes one. Throws Failure for a callsign that nobody has, with those that there are.
std::vector<int> FindVehicles(Station& station, const std::vector<std::string>& names);

/// "UAV3", or "3" when the roster does not know it.
std::string Callsign(const Picture& picture, int vehicle_id);

/// "UAV1, UAV2"; of many only how many there are.
std::string Callsigns(const Picture& picture, const std::vector<int>& vehicle_ids);

}  // namespace skein::cli

#pragma once

#include <string>

#include "cli/station.h"

namespace skein::cli {

/// A row a UAV, as the web page's Formation Information. Wide as it comes, no colours.
std::string StatusTable(const Picture& picture);

/// The same as a JSON array, with the names of the bridge's /api/vehicles; null where nothing is known.
std::string StatusJson(const Picture& picture);

/// A line or two for each formation.
std::string FormationTable(const Picture& picture);

}  // namespace skein::cli

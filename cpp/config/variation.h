#pragma once

#include <cstdint>

#include "config/scenario.h"

namespace skein::config {

/// One flight of a campaign: the scenario with everything that its "vary" block names drawn from the seed.
/// The same on every machine, and the same whatever other seeds are flown. Without such a block, the scenario
/// as it is.
Scenario Varied(Scenario scenario, std::uint64_t seed);

}  // namespace skein::config

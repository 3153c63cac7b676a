#pragma once

#include "config/scenario.h"
#include "monitor/collision_monitor_node.h"

namespace skein::monitor {

/// What a scenario says about proximity: thresholds of strangers, formations and theirs.
CollisionMonitorOptions OptionsOf(const config::Scenario& scenario);

}  // namespace skein::monitor

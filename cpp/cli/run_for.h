#pragma once

#include "bus/live_executor.h"

namespace skein::cli {

/// Runs the executor for a time. Returns false when it ended before, by SIGINT or SIGTERM. May be called
/// again after that: there are links to be restored.
bool RunFor(bus::LiveExecutor& executor, bus::Utime duration);

}  // namespace skein::cli

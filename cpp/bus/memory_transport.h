#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>

namespace skein::bus {

/// A bus within this process, for SimulatedExecutor. Any thread may make one.
std::shared_ptr<lcm::LCM> MemoryTransport();

}  // namespace skein::bus

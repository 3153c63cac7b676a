#pragma once

#include <cstddef>

namespace skein::bus::testing {

/// Bytes that operator new was asked for so far, in all threads.
std::size_t AllocatedBytes();

}  // namespace skein::bus::testing

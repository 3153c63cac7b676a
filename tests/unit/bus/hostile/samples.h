#pragma once

#include <cstdint>
#include <vector>

#include "bus/validate.h"

namespace skein::bus::testing {

/// A valid message of each type that is published, with two of every item.
template <typename Message>
Message Sample();

template <typename Message>
std::vector<std::uint8_t> Encode(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace skein::bus::testing

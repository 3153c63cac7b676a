#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace skein::recording {

/// A type of message that Skein knows, told by the fingerprint that every LCM message begins with: so it is
/// found on whatever channel.
struct MessageType {
  std::string_view name;  ///< "fleet_state_t"
  /// Whether the bytes are a message of this type that a node would take (bus/decode.h, bus/validate.h).
  bool (*is_good)(std::span<const std::byte> data);
};

/// The type whose fingerprint the bytes begin with; null when they are somebody else's, or no message.
const MessageType* TypeOf(std::span<const std::byte> data);

}  // namespace skein::recording

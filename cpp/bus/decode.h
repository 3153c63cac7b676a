#pragma once

#include <cstddef>
#include <optional>
#include <skein/formation_command_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/path_t.hpp>

namespace skein::bus {

/// No message is longer than this. Chunked types stay far below; those that come whole may be long.
template <typename Message>
inline constexpr std::size_t kMaxEncodedBytes = 256 * 1024;
template <>
inline constexpr std::size_t kMaxEncodedBytes<formation_t> = 4 * 1024 * 1024;
template <>
inline constexpr std::size_t kMaxEncodedBytes<formation_command_t> = 4 * 1024 * 1024;
template <>
inline constexpr std::size_t kMaxEncodedBytes<path_t> = 4 * 1024 * 1024;
template <>
inline constexpr std::size_t kMaxEncodedBytes<path_command_t> = 4 * 1024 * 1024;

/// Makes `message` what is in `data`, in the memory that it has. False when the bytes are not exactly one
/// message of this type: then it may be anything. Time and memory are bounded by `size`, which may be
/// anything too: LCM 1.3.1 hands on a datagram of 8 bytes as one of 4294967282.
template <typename Message>
bool DecodeInto(Message& message, const void* data, std::size_t size) {
  if (size > kMaxEncodedBytes<Message>) return false;
  const int length = static_cast<int>(size);
  return message.decode(data, 0, length) == length;
}

/// The message in `data`, or none.
template <typename Message>
std::optional<Message> Decode(const void* data, std::size_t size) {
  Message message;
  if (!DecodeInto(message, data, size)) return std::nullopt;
  return message;
}

}  // namespace skein::bus

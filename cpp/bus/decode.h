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

/// The message in `data`, or none when the bytes are not exactly one message of this type. Time and memory
/// are bounded by `size`, which may be anything: LCM 1.3.1 hands on a datagram of 8 bytes as one of
/// 4294967282.
template <typename Message>
std::optional<Message> Decode(const void* data, std::size_t size) {
  if (size > kMaxEncodedBytes<Message>) return std::nullopt;
  Message message;
  const int length = static_cast<int>(size);
  if (message.decode(data, 0, length) != length) return std::nullopt;
  return message;
}

}  // namespace skein::bus

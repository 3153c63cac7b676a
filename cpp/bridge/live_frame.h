#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace skein::bridge {

/// Something for the browsers, encoded once for all of them.
struct LiveFrame {
  std::shared_ptr<const std::string> bytes;
  bool binary = false;
  std::string key;      ///< a newer frame of the same key replaces one that still waits; "": must not be lost
  bool resets = false;  ///< what was sent before counts no more, but for answers
  bool answer = false;  ///< to one request of this browser
};

/// Frames from this size on are packed [B]: what is smaller gains little, and is read more easily as it is.
inline constexpr std::size_t kPackFrom = 1024;
inline constexpr unsigned char kPackedKind = 4;

/// A large one is deflated into a binary frame: u8 kind = 4, u8 version = 1, u8 what (0: a text, 1: a binary
/// frame), u8 0, u32 size unpacked, raw deflate (RFC 1951). What is binary is sorted first: all first bytes
/// of its 4-byte words, then all second ones, ...; the last 0 to 3 bytes as they are.
LiveFrame TextFrame(const std::string& text, std::string key = "");
LiveFrame BinaryFrame(const std::string& bytes, std::string key);

/// Time has jumped (only in recordings): the page empties its picture.
LiveFrame ResetFrame();

/// As a browser reads it; the same when it is not packed.
/// @throws std::invalid_argument when it is packed and not whole.
LiveFrame Unpacked(const LiveFrame& frame);

}  // namespace skein::bridge

#pragma once

#include <cstdint>
#include <string_view>

namespace skein::bridge {

/// What a Range header asks for.
struct ByteRange {
  enum class Kind {
    kWhole,  ///< no range, or one that a server may pass over: several at once, other units, malformed
    kPart,   ///< `length` bytes from `first` on, all of them there
    kBeyond  ///< it lies behind the end: 416
  };
  Kind kind = Kind::kWhole;
  std::uint64_t first = 0;
  std::uint64_t length = 0;
};

/// @param header value of Range, "" when there is none. @param size of the file.
ByteRange ParseByteRange(std::string_view header, std::uint64_t size);

}  // namespace skein::bridge

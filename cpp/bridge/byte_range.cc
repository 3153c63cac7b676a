#include "bridge/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace skein::bridge {
namespace {

/// Digits and nothing else.
std::optional<std::uint64_t> Number(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

}  // namespace

// RFC 9110, 14.1.2: "first-last", both included; "first-": to the end; "-n": the last n bytes.
ByteRange ParseByteRange(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return {};
  header.remove_prefix(kUnit.size());
  const auto dash = header.find('-');
  if (dash == std::string_view::npos) return {};
  const std::string_view before = header.substr(0, dash);
  const std::string_view after = header.substr(dash + 1);
  if (before.empty()) {
    const auto last_bytes = Number(after);
    if (!last_bytes) return {};
    const std::uint64_t length = std::min(*last_bytes, size);
    if (length == 0) return {.kind = ByteRange::Kind::kBeyond};
    return {.kind = ByteRange::Kind::kPart, .first = size - length, .length = length};
  }
  const auto first = Number(before);
  const auto last = after.empty() ? UINT64_MAX : Number(after);
  if (!first || !last || *last < *first) return {};
  if (*first >= size) return {.kind = ByteRange::Kind::kBeyond};
  return {.kind = ByteRange::Kind::kPart, .first = *first, .length = std::min(*last, size - 1) - *first + 1};
}

}  // namespace skein::bridge

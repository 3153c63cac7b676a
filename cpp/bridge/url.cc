#include "bridge/url.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace skein::bridge {
namespace {

/// Calls `take(key, value, whole)` for each "key=value".
template <typename Take>
void EachPair(std::string_view query, Take take) {
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query = end == std::string_view::npos ? std::string_view() : query.substr(end + 1);
    const std::size_t equals = pair.find('=');
    take(pair.substr(0, equals),
         equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1), pair);
  }
}

}  // namespace

std::optional<std::string> PercentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 3 > text.size()) return std::nullopt;
      unsigned value = 0;
      const char* const end = text.data() + i + 3;
      if (std::from_chars(text.data() + i + 1, end, value, 16).ptr != end) return std::nullopt;
      c = static_cast<char>(value);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20) return std::nullopt;
    decoded += c;
  }
  return decoded;
}

std::string PercentEncoded(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    if (kPlain.find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      encoded += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return encoded;
}

std::string_view QueryOf(std::string_view target) {
  const std::size_t question = target.find('?');
  return question == std::string_view::npos ? std::string_view() : target.substr(question + 1);
}

std::optional<std::string> QueryValue(std::string_view query, std::string_view key) {
  std::optional<std::string> found;
  EachPair(query, [&](std::string_view name, std::string_view value, std::string_view) {
    if (name == key && !found) found = PercentDecoded(value);
  });
  return found;
}

std::string QueryWithout(std::string_view query, std::initializer_list<std::string_view> keys) {
  std::string rest;
  EachPair(query, [&](std::string_view name, std::string_view, std::string_view whole) {
    if (std::ranges::find(keys, name) != keys.end()) return;
    if (!rest.empty()) rest += '&';
    rest += whole;
  });
  return rest;
}

}  // namespace skein::bridge

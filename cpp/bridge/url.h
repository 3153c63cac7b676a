#pragma once

#include <charconv>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace skein::bridge {

/// "a b" of "a%20b"; none where an escape is malformed or stands for a control character.
std::optional<std::string> PercentDecoded(std::string_view text);

/// Everything but letters, digits and "-._~" escaped.
std::string PercentEncoded(std::string_view text);

/// What comes after the question mark of a request's target.
std::string_view QueryOf(std::string_view target);

/// The value of `key` in "a=1&b=2", decoded; none when it is missing or malformed.
std::optional<std::string> QueryValue(std::string_view query, std::string_view key);

/// A text that is a number and nothing else.
template <typename Number>
std::optional<Number> ParseNumber(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The query without these keys.
std::string QueryWithout(std::string_view query, std::initializer_list<std::string_view> keys);

}  // namespace skein::bridge

#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace skein::bridge {

/// "a b" of "a%20b"; none where an escape is malformed or stands for a control character.
std::optional<std::string> PercentDecoded(std::string_view text);

/// Everything but letters, digits and "-._~" escaped.
std::string PercentEncoded(std::string_view text);

/// What comes after the question mark of a request's target.
std::string_view QueryOf(std::string_view target);

/// The value of `key` in "a=1&b=2", decoded; none when it is missing or malformed.
std::optional<std::string> QueryValue(std::string_view query, std::string_view key);

/// The query without these keys.
std::string QueryWithout(std::string_view query, std::initializer_list<std::string_view> keys);

}  // namespace skein::bridge

#pragma once

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <string>

/// What a number on a command line must be, said in words. CLI11's own checks let "nan" through, and tell of
/// 309 digits.
namespace skein::bus {

inline CLI::Validator NumberCheck(double least, double most, const std::string& wanted,
                                  bool without_least = false) {
  const auto check = [=](const std::string& text) -> std::string {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most &&
        !(without_least && number == least)) {
      return "";
    }
    return fmt::format("must be {}, is {}", wanted, text);
  };
  return {check, "NUMBER " + wanted};
}

inline CLI::Validator Between(double least, double most) {
  return NumberCheck(least, most, fmt::format("{:g} .. {:g}", least, most));
}

/// As seconds these are 31 years: more means nothing, and much more does not fit into microseconds.
inline constexpr double kMost = 1e9;

inline CLI::Validator NotNegative() { return NumberCheck(0, kMost, "0 .. 1e9"); }
inline CLI::Validator Positive() { return NumberCheck(0, kMost, "above 0, and at most 1e9", true); }

}  // namespace skein::bus

// A message field by field, for people.
#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/log/text.h"
#include "cli/spy.h"
#include "cli/text_table.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kFirstClock_us = 1'000'000'000'000'000;  // 2001: what is smaller is no time of day
constexpr const char* kIndent = "  ";

/// The time of day of fields that hold one.
std::string Clock(const std::string& name, const Json& value) {
  if (!name.ends_with("utime") && !name.ends_with("session_id")) return "";
  if (!value.is_number_integer() || value.get<std::int64_t>() < kFirstClock_us) return "";
  const auto us = value.get<std::int64_t>();
  return fmt::format("  ({:%F %T}.{:03d} UTC)", fmt::gmtime(static_cast<std::time_t>(us / 1'000'000)),
                     us / 1'000 % 1'000);
}

std::string Scalar(const Json& value) {
  if (value.is_string()) return Printable(value.get_ref<const std::string&>());
  if (value.is_number_float()) return fmt::format("{:.10g}", value.get<double>());
  return value.dump();
}

bool IsTable(const Json& list) {
  return std::all_of(list.begin(), list.end(), [](const Json& item) {
    return item.is_object() &&
           std::none_of(item.begin(), item.end(), [](const Json& field) { return field.is_structured(); });
  });
}

std::size_t LongestLine(const std::string& text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  return longest;
}

std::string Indented(const std::string& text) {
  std::string indented;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    indented += kIndent + text.substr(begin, end - begin);
    begin = end;
  }
  return indented;
}

std::string ListText(const std::string& name, const Json& list, std::size_t width) {
  if (list.empty()) return name + "[0]\n";
  const std::string heading = fmt::format("{}[{}]\n", name, list.size());
  if (!list.front().is_structured()) {
    std::string values;
    for (const Json& value : list) values += ' ' + Scalar(value);
    return fmt::format("{}[{}]{}\n", name, list.size(), values);
  }
  const std::size_t inner = width > 2 ? width - 2 : width;
  if (IsTable(list)) {
    Table table = {{}};
    for (const auto& [key, unused] : list.front().items()) table.front().push_back(key);
    for (const Json& item : list) {
      auto& row = table.emplace_back();
      for (const Json& value : item) row.push_back(Scalar(value));
    }
    const std::string text = Aligned(table, 0);
    if (width == 0 || LongestLine(text) <= inner) return heading + Indented(text);
  }
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    text += fmt::format("{}[{}]\n", name, i) + Indented(MessageText(list[i], inner));
  }
  return text;
}

}  // namespace

std::string MessageText(const Json& fields, std::size_t width) {
  std::size_t widest = 0;
  for (const auto& [name, value] : fields.items()) {
    if (!value.is_structured()) widest = std::max(widest, name.size());
  }
  std::string text;
  for (const auto& [name, value] : fields.items()) {
    if (value.is_array()) {
      text += ListText(name, value, width);
    } else if (value.is_object()) {
      text += name + '\n' + Indented(MessageText(value, width > 2 ? width - 2 : width));
    } else {
      text += fmt::format("{:<{}}  {}{}\n", name, widest, Scalar(value), Clock(name, value));
    }
  }
  return text;
}

}  // namespace skein::cli

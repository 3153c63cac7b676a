#include "bridge/history_query.h"

#include <cmath>
#include <optional>

#include "bridge/url.h"

namespace skein::bridge {
namespace {

/// Cuts off what comes before the next `separator`.
std::string_view Next(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return part;
}

}  // namespace

std::variant<HistoryQuery, std::string> ParseHistoryQuery(std::string_view query) {
  HistoryQuery result;
  while (!query.empty()) {
    std::string_view value = Next(query, '&');
    const std::string_view name = Next(value, '=');
    if (name == "ids") {
      while (!value.empty()) {
        const auto id = ParseNumber<std::int32_t>(Next(value, ','));
        if (!id || *id < 1) return "ids: must be whole numbers from 1 on, with commas between them.";
        result.ids.push_back(*id);
      }
    } else if (name == "since") {
      const auto since_s = ParseNumber<double>(value);
      if (!since_s || !std::isfinite(*since_s)) return "since: must be seconds since the scenario's start.";
      result.since_s = *since_s;
    } else {
      return "Only ids and since may be asked for.";
    }
  }
  if (result.ids.empty()) return "ids: name the UAVs, such as ?ids=1,2,3.";
  if (result.ids.size() > HistoryQuery::kMostIds) {
    return "ids: not more than " + std::to_string(HistoryQuery::kMostIds) + " of one request.";
  }
  return result;
}

}  // namespace skein::bridge

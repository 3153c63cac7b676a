#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace skein::bridge {

struct HistoryQuery {
  static constexpr std::size_t kMostIds = 32;  ///< of one request: it is encoded in one go

  std::vector<std::int32_t> ids;
  double since_s = -1;  ///< only samples after this
};

/// What comes after the question mark of GET /api/history: "ids=1,2,3&since=12.5"; or a sentence that tells
/// what is wrong.
std::variant<HistoryQuery, std::string> ParseHistoryQuery(std::string_view query);

}  // namespace skein::bridge

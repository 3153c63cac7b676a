#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "bridge/history.h"

namespace skein::bridge {

/// What comes after the question mark of GET /api/history: "ids=1,2,3&since=12.5"; or a sentence that tells
/// what is wrong.
std::variant<HistoryQuery, std::string> ParseHistoryQuery(std::string_view query);

}  // namespace skein::bridge

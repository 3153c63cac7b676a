#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace skein::testing {

/// The report of link-drop --json. Before it LCM may say what it thinks of its buffers.
inline nlohmann::json DropReportIn(const std::string& output) {
  const auto start = output.find("{\n  \"drops\"");
  EXPECT_NE(start, std::string::npos) << output;
  return start == std::string::npos ? nlohmann::json() : nlohmann::json::parse(output.substr(start));
}

}  // namespace skein::testing

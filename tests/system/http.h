#pragma once

#include <optional>
#include <string>

namespace skein::testing {

/// The body of http://127.0.0.1:port/path; none when nobody answers or not with 200.
std::optional<std::string> HttpGet(int port, const std::string& path);

}  // namespace skein::testing

#pragma once

#include <optional>
#include <string>

namespace skein::testing {

/// The body of http://127.0.0.1:port/path; none when nobody answers or not with 200.
std::optional<std::string> HttpGet(int port, const std::string& path);

/// The answer to a POST of JSON: its status, 0 when nobody answers, and its body.
struct HttpAnswer {
  int status = 0;
  std::string body;
};
HttpAnswer HttpPost(int port, const std::string& path, const std::string& json);

}  // namespace skein::testing

// By itself, as httplib.h brings macros that clash with Eigen.
#include "system/http.h"

#include <httplib.h>

namespace skein::testing {

std::optional<std::string> HttpGet(int port, const std::string& path) {
  httplib::Client client("127.0.0.1", port);
  client.set_connection_timeout(2);
  client.set_read_timeout(5);
  const auto answer = client.Get(path);
  if (!answer || answer->status != 200) return std::nullopt;
  return answer->body;
}

HttpAnswer HttpPost(int port, const std::string& path, const std::string& json) {
  httplib::Client client("127.0.0.1", port);
  client.set_connection_timeout(2);
  client.set_read_timeout(5);
  const auto answer = client.Post(path, json, "application/json");
  if (!answer) return {};
  return {answer->status, answer->body};
}

}  // namespace skein::testing

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

}  // namespace skein::testing

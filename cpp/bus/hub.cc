#include "bus/hub.h"

#include <netdb.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <regex>

namespace skein::bus {
namespace {

constexpr timespec kRetry{0, 500'000'000};
constexpr timeval kPatience{2, 0};

/// As LCM reads it.
bool TakesConnections(const std::string& host, const std::string& port) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* address = nullptr;
  if (getaddrinfo(host.c_str(), port.c_str(), &wanted, &address) != 0) return false;
  const int fd = socket(address->ai_family, address->ai_socktype | SOCK_CLOEXEC, 0);
  setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  const bool taken = connect(fd, address->ai_addr, address->ai_addrlen) == 0;
  close(fd);
  freeaddrinfo(address);
  return taken;
}

}  // namespace

bool AwaitHub(const std::string& url) {
  static const std::regex pattern(R"(tcpq://([^:/?]*)(?::([0-9]+))?.*)");
  std::smatch match;
  if (!std::regex_match(url, match, pattern)) return true;
  const std::string host = match[1].length() > 0 ? match[1].str() : "127.0.0.1";
  const std::string port = match[2].matched ? match[2].str() : "7700";
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  for (bool told = false; !TakesConnections(host, port); told = true) {
    if (!told) spdlog::warn("there is no hub at {}: waits for it", url);
    if (sigtimedwait(&ends, nullptr, &kRetry) > 0) return false;
  }
  return true;
}

}  // namespace skein::bus

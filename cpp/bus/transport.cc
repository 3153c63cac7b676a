#include "bus/transport.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <regex>

namespace skein::bus {
namespace {

// Asked for when the URL says nothing. The kernel grants as much of it as net.core.rmem_max allows: by
// default that is still twice of what it gives unasked.
constexpr int kReceiveBufferBytes = 4 * 1024 * 1024;

/// The parts of an udpm:// URL that matter here.
struct UdpUrl {
  std::string group;
  int port = 7667;
  int wanted_buffer_bytes = 0;  ///< 0: not said
};

std::optional<UdpUrl> ParseUdpUrl(const std::string& url) {
  static const std::regex pattern(R"(udpm://([0-9.]*)(?::([0-9]{1,9}))?(?:\?(.*))?)");
  static const std::regex buffer(R"((?:^|&)recv_buf_size=([0-9]{1,9})(?:&|$))");
  std::smatch match;
  if (!std::regex_match(url, match, pattern)) return std::nullopt;
  UdpUrl parts;
  parts.group = match[1].length() > 0 ? match[1].str() : "239.255.76.67";
  if (match[2].matched) parts.port = std::stoi(match[2]);
  const std::string options = match[3].str();
  if (std::regex_search(options, match, buffer)) parts.wanted_buffer_bytes = std::stoi(match[1]);
  return parts;
}

/// Asks the kernel before LCM does, for LCM prints a page of advice that no longer works.
void CheckUdp(const UdpUrl& url, const std::string& text) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(url.port));
  if (inet_pton(AF_INET, url.group.c_str(), &address.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.sin_addr.s_addr))) {
    throw StartError(text + ": " + url.group + " is not a multicast address (224.0.0.0 to 239.255.255.255)");
  }
  if (url.port < 1 || url.port > 65535) throw StartError(text + ": the port must be 1 to 65535");
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw StartError(text + ": no UDP socket: " + std::strerror(errno));
  const bool reachable = connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  close(fd);
  if (!reachable) {
    throw StartError(
        text + ": no route to the multicast group (" + std::strerror(error) +
        "). On a host without a network this makes one, for this group only: ip link set lo up && "
        "ip route add " +
        url.group + "/32 dev lo");
  }
}

/// Buffer of this process' UDP socket that is bound to `port`: LCM gives no way to ask for it.
std::int64_t ReceiveBufferBytes(int port) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int fd = std::atoi(entry.path().filename().c_str());
    sockaddr_in address{};
    socklen_t length = sizeof address;
    if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) != 0) continue;
    if (address.sin_family != AF_INET || ntohs(address.sin_port) != port) continue;
    int type = 0;
    length = sizeof type;
    if (getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &length) != 0 || type != SOCK_DGRAM) continue;
    int bytes = 0;
    length = sizeof bytes;
    if (getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &bytes, &length) == 0) return bytes;
  }
  return 0;
}

}  // namespace

std::string DefaultUrl() {
  const char* url = std::getenv("LCM_DEFAULT_URL");
  return url && *url ? url : kDefaultUrl;
}

std::string WithReceiveBuffer(const std::string& url) {
  const auto udp = ParseUdpUrl(url);
  if (!udp || udp->wanted_buffer_bytes != 0) return url;
  return url + (url.find('?') == std::string::npos ? "?" : "&") +
         ("recv_buf_size=" + std::to_string(kReceiveBufferBytes));
}

Transport MakeTransport(const std::string& url) {
  const auto udp = ParseUdpUrl(url);
  if (udp) CheckUdp(*udp, url);
  Transport transport{std::make_shared<lcm::LCM>(WithReceiveBuffer(url)), 0};
  // Asking for the file descriptor makes LCM open its receiving side, with a test of its own.
  if (!transport.lcm->good() || transport.lcm->getFileno() < 0) {
    const std::string advice =
        udp ? "do the firewall and the multicast route let packets to the own host through?"
        : url.starts_with("tcpq:") ? "is the hub (lcm.lcm.TCPService) running there?"
                                   : "is it udpm://, tcpq://, memq:// or file://?";
    throw StartError(url + ": LCM cannot open this URL: " + advice);
  }
  if (udp) {
    transport.receive_buffer_bytes = ReceiveBufferBytes(udp->port);
    // The kernel reports twice what was asked for, its own overhead included.
    if (udp->wanted_buffer_bytes > transport.receive_buffer_bytes / 2) {
      spdlog::warn(
          "the kernel granted a receive buffer of {} B, {} B were asked for: sysctl -w net.core.rmem_max={}",
          transport.receive_buffer_bytes / 2, udp->wanted_buffer_bytes, udp->wanted_buffer_bytes);
    }
  }
  return transport;
}

}  // namespace skein::bus

// Raw bytes at web-bridge's port: HTTP requests, or after an upgrade frames of the WebSocket (first byte
// odd).
#include <utility>

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <csignal>
#include <string>

#include "fuzz_target.h"
#include "unit/bridge/bridge_under_test.h"

namespace skein {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

constexpr const char* kUpgrade =
    "GET /live HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

/// Sends it all, says that no more comes, and waits until the other side has closed.
void Send(std::uint16_t port, const std::string& bytes) {
  asio::io_context context;
  Tcp::socket socket(context);
  boost::system::error_code error;
  // Each from another of loopback's own addresses: the ports of one are used up within a minute.
  static std::uint8_t host = 0;
  socket.open(Tcp::v4());
  socket.bind({asio::ip::address_v4({127, 1, 1, ++host}), 0});
  // libFuzzer's clock must not interrupt this.
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &alarm, nullptr);
  socket.connect({asio::ip::address_v4::loopback(), port}, error);
  pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  fuzz::Require(!error, ("the bridge listens: " + error.message()).c_str());
  asio::write(socket, asio::buffer(bytes), error);
  socket.shutdown(Tcp::socket::shutdown_send, error);
  std::array<char, 4096> answer;
  while (!error) socket.read_some(asio::buffer(answer), error);
}

}  // namespace
}  // namespace skein

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static skein::bridge::BridgeUnderTest bridge;
  if (size == 0) return 0;
  std::string bytes = data[0] % 2 == 1 ? skein::kUpgrade : "";
  bytes.append(reinterpret_cast<const char*>(data + 1), size - 1);
  skein::Send(bridge.port(), bytes);
  return 0;
}

#include "bridge/live_session.h"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "bridge/await.h"

namespace skein::bridge {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::size_t kMaxMessageBytes = 1u << 20;
// What the kernel holds back for a slow browser is old by the time it arrives; so little of it.
constexpr int kSendBufferBytes = 256 * 1024;

}  // namespace

LiveSession::LiveSession(beast::tcp_stream stream) : socket_(std::move(stream)) {}

asio::awaitable<bool> LiveSession::Accept(const HttpRequest& request) {
  auto& tcp = beast::get_lowest_layer(socket_);
  Error ignored;
  tcp.socket().set_option(asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
  // From here on the WebSocket has time-outs of its own: it pings a silent browser and gives up after 30 s.
  tcp.expires_never();
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = std::chrono::seconds(10);
  timeout.idle_timeout = std::chrono::seconds(30);
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.read_message_max(kMaxMessageBytes);
  socket_.auto_fragment(false);
  const auto [error] = co_await socket_.async_accept(request, kAwait);
  open_ = !error;
  co_return open_;
}

asio::awaitable<void> LiveSession::Run(Hear hear) {
  const auto self = shared_from_this();
  beast::flat_buffer buffer;
  for (;;) {
    const auto [error, size] = co_await socket_.async_read(buffer, kAwait);
    if (error) break;
    if (!socket_.got_text()) {
      // Nothing binary is ever wanted from a browser.
      co_await socket_.async_close(websocket::close_code::unknown_data, kAwait);
      break;
    }
    hear(self, beast::buffers_to_string(buffer.data()));
    buffer.consume(buffer.size());
  }
  Cut();
}

void LiveSession::Send(LiveFrame frame) {
  if (!open_) return;
  if (outbox_.Push(std::move(frame))) {
    WriteNext();
  } else {
    Cut();
  }
}

void LiveSession::WriteNext() {
  if (writing_) return;
  const auto frame = outbox_.Pop();
  if (!frame) return;
  writing_ = true;
  socket_.binary(frame->binary);
  socket_.async_write(asio::buffer(*frame->bytes),
                      [self = shared_from_this(), bytes = frame->bytes](Error error, std::size_t) {
                        self->writing_ = false;
                        if (!error && self->open_) self->WriteNext();
                      });
}

void LiveSession::Cut() {
  open_ = false;
  beast::get_lowest_layer(socket_).close();
}

}  // namespace skein::bridge

#include "live_client.h"

#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <stdexcept>

#include "bridge/live_frame.h"

namespace skein::bridge {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Error = boost::system::error_code;

struct LiveClient::Impl {
  asio::io_context context;
  websocket::stream<beast::tcp_stream> socket{context};
  beast::flat_buffer buffer;

  /// Runs an operation that tells its error, for 10 s at most.
  Error Run(const std::function<void(std::function<void(Error)>)>& start) {
    std::optional<Error> result;
    start([&](Error error) { result = error; });
    context.restart();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!result && context.run_one_until(end) > 0) {
    }
    if (!result) throw std::runtime_error("nothing happened for 10 s");
    return *result;
  }
};

LiveClient::LiveClient(std::uint16_t port, const std::string& origin, const std::string& target,
                       int receive_buffer_bytes, const std::string& token)
    : impl_(std::make_unique<Impl>()) {
  auto& tcp = beast::get_lowest_layer(impl_->socket).socket();
  tcp.open(asio::ip::tcp::v4());
  if (receive_buffer_bytes > 0) tcp.set_option(asio::socket_base::receive_buffer_size(receive_buffer_bytes));
  tcp.connect({asio::ip::make_address("127.0.0.1"), port});
  impl_->socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    if (!origin.empty()) request.set(beast::http::field::origin, origin);
    if (!token.empty()) request.set(beast::http::field::authorization, "Bearer " + token);
  }));
  const Error error = impl_->Run(
      [&](auto done) { impl_->socket.async_handshake("127.0.0.1:" + std::to_string(port), target, done); });
  if (error) throw std::runtime_error(error.message());
}

LiveClient::~LiveClient() = default;

std::optional<LiveClient::Message> LiveClient::Read() {
  impl_->buffer.clear();
  const Error error = impl_->Run([&](auto done) {
    impl_->socket.async_read(impl_->buffer, [done](Error error, std::size_t) { done(error); });
  });
  if (error) return std::nullopt;
  const LiveFrame frame =
      Unpacked({std::make_shared<const std::string>(beast::buffers_to_string(impl_->buffer.data())),
                impl_->socket.got_binary(), ""});
  return Message{frame.binary, *frame.bytes};
}

nlohmann::json LiveClient::ReadText(const std::string& type) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (const auto message = Read()) {
    if (!message->binary) {
      auto text = nlohmann::json::parse(message->bytes);
      if (text["type"] == type) return text;
    }
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no " + type + " for 10 s");
  }
  return nullptr;
}

std::string LiveClient::ReadBinary(char kind) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (const auto message = Read()) {
    if (message->binary && message->bytes.front() == kind) return message->bytes;
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no such frame for 10 s");
  }
  return "";
}

void LiveClient::Send(const std::string& text, bool binary) {
  impl_->socket.binary(binary);
  impl_->Run([&](auto done) {
    impl_->socket.async_write(asio::buffer(text), [done](Error error, std::size_t) { done(error); });
  });
}

void LiveClient::SendRaw(const std::string& bytes) {
  asio::write(beast::get_lowest_layer(impl_->socket).socket(), asio::buffer(bytes));
}

}  // namespace skein::bridge

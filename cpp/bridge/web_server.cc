#include "bridge/web_server.h"

#include <spdlog/spdlog.h>

#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <exception>

#include "bridge/await.h"
#include "bridge/file_download.h"
#include "bus/transport.h"

namespace skein::bridge {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;
using std::chrono::seconds;

// A whole header must have come in by then, also the next one of a connection that is kept.
constexpr seconds kHeaderTime{20};
constexpr seconds kBodyTime{20};
// The largest file takes 30 s over 2 Mbit/s.
constexpr seconds kResponseTime{60};
// Only a fault of ours takes longer: commands are given up after 2 s, flights ahead after 5 s, and one of
// those waits for four others at most.
constexpr seconds kAnswerTime{30};
constexpr std::chrono::milliseconds kLookPeriod{250};
// Between two accepted connections all others have their turn: one at a time, and a flood of connections
// keeps a browser waiting for as many turns.
constexpr int kAcceptedAtOnce = 16;
constexpr std::uint32_t kMaxHeaderBytes = 16 * 1024;
constexpr std::uint64_t kMaxBodyBytes = 1u << 20;

Tcp::acceptor Listen(asio::io_context& context, const std::string& address, std::uint16_t port,
                     bool demands_tokens) {
  if (!demands_tokens && !IsLoopback(address)) {
    throw bus::StartError(
        "--listen " + address +
        " lets others than this host in, and whoever gets in commands the fleet: make tokens "
        "(skein token new NAME --role operator), and start with --tokens");
  }
  const std::string where = address + ":" + std::to_string(port);
  Error error;
  const auto ip = asio::ip::make_address(address == "localhost" ? "127.0.0.1" : address, error);
  if (error) throw bus::StartError("--listen " + address + ": is not an IP address of this host");
  Tcp::acceptor acceptor(context);
  const Tcp::endpoint endpoint(ip, port);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) {
    throw bus::StartError("port " + std::to_string(port) + " on " + address +
                          " is taken by another program: choose another one with --port N");
  }
  if (error) throw bus::StartError("cannot listen on " + where + ": " + error.message());
  return acceptor;
}

/// The answer to a request that could not be read; none when the other side went away or was too slow.
std::optional<http::status> StatusOf(Error error) {
  if (error == http::error::header_limit) return http::status::request_header_fields_too_large;
  if (error == http::error::body_limit) return http::status::payload_too_large;
  const bool malformed = error.category() == make_error_code(http::error::bad_method).category();
  if (malformed && error != http::error::end_of_stream && error != http::error::partial_message) {
    return http::status::bad_request;
  }
  return std::nullopt;
}

asio::awaitable<Error> Write(beast::tcp_stream& stream, const HttpResponse& response, bool head) {
  stream.expires_after(kResponseTime);
  if (!head) {
    const auto [error, size] = co_await http::async_write(stream, response, kAwait);
    co_return error;
  }
  // The same header, length included, and nothing behind it.
  const http::response<http::empty_body> bodiless(response.base());
  const auto [error, size] = co_await http::async_write(stream, bodiless, kAwait);
  co_return error;
}

/// Says that no more comes and lets the answer arrive; closing at once while the other side still sends would
/// reset the connection.
asio::awaitable<void> Close(beast::tcp_stream& stream) {
  Error ignored;
  stream.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  stream.expires_after(seconds(2));
  std::array<char, 4096> rest;
  for (;;) {
    const auto [error, size] = co_await stream.async_read_some(asio::buffer(rest), kAwait);
    if (error) break;
  }
}

}  // namespace

WebServer::WebServer(asio::io_context& context, const std::string& address, std::uint16_t port,
                     const RouterOptions& options, const Backend& backend)
    : context_(context),
      doorkeeper_(options.tokens_file),
      acceptor_(Listen(context, address, port, doorkeeper_.demands_tokens())),
      recordings_(options.recordings),
      router_(options, backend, doorkeeper_, [this](const HttpHead& head) { return WhyNot(head); }),
      hub_(backend) {
  doorkeeper_.SetTell(backend.tell);
  for (int i = 0; i < kAcceptedAtOnce; ++i) asio::co_spawn(context_, AcceptAll(), asio::detached);
  asio::co_spawn(context_, LookAfterPeople(), asio::detached);
}

asio::awaitable<void> WebServer::AcceptAll() {
  for (;;) {
    auto [error, socket] = co_await acceptor_.async_accept(kAwait);
    if (error) {
      // Out of file descriptors, most likely; connections that end give some back.
      asio::steady_timer pause(context_, std::chrono::milliseconds(100));
      co_await pause.async_wait(kAwait);
      continue;
    }
    if (connections_.use_count() > kMaxConnections) {
      if (idle_.empty()) continue;
      idle_.begin()->second->close();
      idle_.erase(idle_.begin());
    }
    asio::co_spawn(context_, Serve(std::move(socket), connections_), [](std::exception_ptr failure) {
      if (!failure) return;
      try {
        std::rethrow_exception(failure);
      } catch (const std::exception& exception) {
        spdlog::error("a connection failed: {}", exception.what());
      }
    });
  }
}

asio::awaitable<void> WebServer::LookAfterPeople() {
  asio::steady_timer pause(context_);
  for (;;) {
    pause.expires_after(kLookPeriod);
    co_await pause.async_wait(kAwait);
    hub_.Look();
    if (doorkeeper_.Refresh()) CutWhoMayNoMore();
  }
}

asio::awaitable<void> WebServer::Serve(Tcp::socket socket, [[maybe_unused]] std::shared_ptr<void> place) {
  Error error;
  const Tcp::endpoint local = socket.local_endpoint(error);
  if (error) co_return;
  const Tcp::endpoint remote = socket.remote_endpoint(error);
  if (error) co_return;
  const Caller caller{local.address().to_string(), local.port(), remote.address().to_string()};
  socket.set_option(Tcp::no_delay(true), error);
  beast::tcp_stream stream(std::move(socket));
  beast::flat_buffer buffer(kMaxHeaderBytes + 64 * 1024);
  std::int64_t waiting = 0;
  const auto wait = [&] { idle_[waiting = ++last_idle_] = &stream; };
  const auto work = [&] { idle_.erase(waiting); };
  for (bool keep_alive = true; keep_alive;) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(kMaxHeaderBytes);
    parser.body_limit(kMaxBodyBytes);
    stream.expires_after(kHeaderTime);
    wait();
    std::tie(error, std::ignore) = co_await http::async_read_header(stream, buffer, parser, kAwait);
    std::optional<HttpResponse> response;
    if (!error) {
      const bool upgrade = beast::websocket::is_upgrade(parser.get());
      response = router_.TurnAway(parser.get(), caller, upgrade);
      if (!response && upgrade) {
        work();
        co_await ServeLive(std::move(stream), parser.release());
        co_return;
      }
      if (!response && beast::iequals(parser.get()[http::field::expect], "100-continue")) {
        const http::response<http::empty_body> go_on(http::status::continue_, 11);
        std::tie(error, std::ignore) = co_await http::async_write(stream, go_on, kAwait);
      }
      if (!response && !error) {
        stream.expires_after(kBodyTime);
        std::tie(error, std::ignore) = co_await http::async_read(stream, buffer, parser, kAwait);
      }
    }
    work();
    const HttpRequest request = parser.release();
    const bool whole = !response && !error;
    if (whole) {
      if (auto download = router_.recordings().FindFile(request)) {
        keep_alive = request.keep_alive();
        download->head.keep_alive(keep_alive);
        error = co_await SendFile(stream, *download, request.method() == http::verb::head);
        if (error) co_return;
        continue;
      }
    }
    if (error) {
      const auto status = StatusOf(error);
      if (!status) break;
      response = router_.Plain(*status, "The request cannot be read: " + error.message() + ".");
    } else if (!response) {
      response = co_await Answer(request, caller, stream.socket());
    }
    // A body that was not read would be taken for the next request.
    keep_alive = whole && request.keep_alive();
    response->keep_alive(keep_alive);
    wait();
    error = co_await Write(stream, *response, request.method() == http::verb::head);
    work();
    if (error) co_return;
  }
  co_await Close(stream);
}

asio::awaitable<HttpResponse> WebServer::Answer(const HttpRequest& request, const Caller& caller,
                                                Tcp::socket& from) {
  // The answer may come after this connection is gone, so what it touches is shared.
  struct Pending {
    asio::steady_timer changed;
    std::optional<HttpResponse> response;
    bool heard_more = false;
    Previewer::Gone gone = std::make_shared<std::atomic<bool>>(false);
  };
  const auto pending =
      std::make_shared<Pending>(Pending{asio::steady_timer(context_, kAnswerTime), std::nullopt});
  router_.Answer(request, caller, pending->gone, [pending](HttpResponse response) {
    pending->response = std::move(response);
    pending->changed.cancel();
  });
  if (pending->response) co_return std::move(*pending->response);
  from.async_wait(Tcp::socket::wait_read, [pending](Error error) {
    pending->heard_more = !error;
    if (!error) pending->changed.cancel();
  });
  co_await pending->changed.async_wait(kAwait);
  Error error;
  if (!pending->response && pending->heard_more) {
    // More than nothing is the next request. Nothing is an end: a browser that has thought better of it.
    *pending->gone = from.available(error) == 0;
    co_await pending->changed.async_wait(kAwait);
  }
  from.cancel(error);
  if (!pending->response)
    co_return router_.Plain(http::status::internal_server_error, "The bridge found no answer.");
  co_return std::move(*pending->response);
}

asio::awaitable<void> WebServer::ServeLive(beast::tcp_stream stream, HttpRequest request) {
  const auto session = std::make_shared<LiveSession>(std::move(stream));
  session->secret = doorkeeper_.SecretOf(request, port());
  session->visitor = doorkeeper_.Identify(session->secret);
  const std::string recording = router_.recordings().Watched(View(request.target()));
  const bool accepted = co_await session->Accept(request);
  if (!accepted) co_return;
  std::erase_if(live_, [](const auto& weak) { return weak.expired(); });
  live_.push_back(session);
  if (!recording.empty()) {
    co_await ServeRecording(session, recording);
    co_return;
  }
  hub_.Join(session);
  co_await session->Run(
      [this](const std::shared_ptr<LiveSession>& from, const std::string& text) { hub_.Hear(from, text); });
  hub_.Leave(session);
}

asio::awaitable<void> WebServer::ServeRecording(const std::shared_ptr<LiveSession>& session,
                                                const std::string& name) {
  const auto hear = recordings_->watch(name, [this, weak = std::weak_ptr(session)](const LiveFrame& frame) {
    asio::post(context_, [weak, frame] {
      if (const auto session = weak.lock()) session->Send(frame);
    });
  });
  if (!hear) {
    spdlog::warn("too many browsers look at recordings: one is turned away");
    co_return;
  }
  co_await session->Run(
      [&hear](const std::shared_ptr<LiveSession>&, const std::string& text) { hear(text); });
}

std::string WebServer::WhyNot(const HttpHead& head) const {
  if (!doorkeeper_.Identify(doorkeeper_.SecretOf(head, port())).rights.operate)
    return "this session may only look";
  if (recordings_ && !recordings_->live_bus) return "";
  return hub_.WhyNot(std::string(View(head["Control-Token"])));
}

void WebServer::CutWhoMayNoMore() {
  for (const auto& weak : live_) {
    const auto session = weak.lock();
    // It comes back, and is let in or not.
    if (session && doorkeeper_.Identify(session->secret).rights != session->visitor.rights) session->Cut();
  }
}

}  // namespace skein::bridge

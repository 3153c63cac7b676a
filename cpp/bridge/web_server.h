#pragma once

// GCC 12 with Boost 1.74 needs <utility> before Asio.
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bridge/doorkeeper.h"
#include "bridge/http_router.h"
#include "bridge/live_hub.h"

namespace skein::bridge {

/// Page, JSON API and WebSocket on one port. Runs on, and belongs to, the thread that runs `context`.
class WebServer {
 public:
  /// Listens at once; `port` 0 takes a free one. Throws bus::StartError, saying what to do, when it cannot;
  /// also when others than this host would reach it and no tokens are demanded.
  WebServer(boost::asio::io_context& context, const std::string& address, std::uint16_t port,
            const RouterOptions& options, const Backend& backend);

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  LiveHub& hub() { return hub_; }

  /// More make room for one another: who has said nothing for longest is cut off.
  static constexpr int kMaxConnections = 256;

 private:
  using Tcp = boost::asio::ip::tcp;
  boost::asio::awaitable<void> AcceptAll();
  boost::asio::awaitable<void> LookAfterPeople();
  boost::asio::awaitable<void> Serve(Tcp::socket socket, std::shared_ptr<void> place);
  boost::asio::awaitable<HttpResponse> Answer(const HttpRequest& request, const Caller& caller,
                                              Tcp::socket& from);
  boost::asio::awaitable<void> ServeLive(boost::beast::tcp_stream stream, HttpRequest request);
  boost::asio::awaitable<void> ServeRecording(const std::shared_ptr<LiveSession>& session,
                                              const std::string& name);
  std::string WhyNot(const HttpHead& head) const;
  void CutWhoMayNoMore();

  boost::asio::io_context& context_;
  Doorkeeper doorkeeper_;
  Tcp::acceptor acceptor_;
  std::shared_ptr<const Recordings> recordings_;  ///< null: none
  HttpRouter router_;
  LiveHub hub_;
  std::vector<std::weak_ptr<LiveSession>> live_;                 ///< all on a WebSocket
  std::shared_ptr<void> connections_ = std::make_shared<int>();  ///< each connection holds a share of it
  /// Connections that wait for the other side, the longest first: they give way to newcomers.
  std::map<std::int64_t, boost::beast::tcp_stream*> idle_;
  std::int64_t last_idle_ = 0;
};

}  // namespace skein::bridge

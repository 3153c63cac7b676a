#pragma once

// GCC 12 with Boost 1.74 needs <utility> before Asio.
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <functional>
#include <memory>
#include <string>

#include "bridge/doorkeeper.h"
#include "bridge/http_types.h"
#include "bridge/outbox.h"

namespace skein::bridge {

/// One browser on the WebSocket. Belongs to the thread that runs its executor.
class LiveSession : public std::enable_shared_from_this<LiveSession> {
 public:
  using Hear = std::function<void(const std::shared_ptr<LiveSession>&, const std::string& text)>;

  explicit LiveSession(boost::beast::tcp_stream stream);

  /// Upgrades; false when that fails.
  boost::asio::awaitable<bool> Accept(const HttpRequest& request);

  /// Hears the browser until it goes, or breaks a rule.
  boost::asio::awaitable<void> Run(Hear hear);

  /// Never waits: queues behind what is being sent. A browser that lets more than Outbox::kMaxBytes wait is
  /// cut off.
  void Send(LiveFrame frame);

  /// Commands that have not been answered yet.
  int waiting_commands = 0;
  /// Who is at the other end, for the control desk; 0: nobody has said yet.
  int person = 0;
  /// The token that it came with, and whose that is.
  std::string secret;
  Visitor visitor;

  /// Ends the connection at once.
  void Cut();

 private:
  void WriteNext();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Outbox outbox_;
  bool writing_ = false;
  bool open_ = false;
};

}  // namespace skein::bridge

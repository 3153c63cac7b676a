#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bridge/backend.h"
#include "bridge/live_session.h"

namespace skein::bridge {

/// All browsers on the WebSocket. Belongs to the web server's thread.
class LiveHub {
 public:
  explicit LiveHub(Backend backend) : backend_(std::move(backend)) {}

  /// Sends it the last of everything; from then on it gets what is broadcast.
  void Join(const std::shared_ptr<LiveSession>& session);
  void Broadcast(const LiveFrame& frame);
  /// A text from a browser: a command. Whatever is wrong with it is told in an "ack".
  void Hear(const std::shared_ptr<LiveSession>& session, const std::string& text) const;

  static constexpr int kMaxWaitingCommands = 16;  ///< of one browser

 private:
  Backend backend_;
  std::vector<std::weak_ptr<LiveSession>> sessions_;
};

}  // namespace skein::bridge

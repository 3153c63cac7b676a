#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bridge/backend.h"
#include "bridge/control_desk.h"
#include "bridge/live_session.h"

namespace skein::bridge {

/// All browsers on the WebSocket, and who of them may command. Belongs to the web server's thread.
class LiveHub {
 public:
  explicit LiveHub(Backend backend) : backend_(std::move(backend)), desk_(backend_.tell) {}

  /// Before anybody joins: see ControlDesk::WaitFor.
  void WaitFor(const KeptHolder& holder);
  /// Sends it the last of everything; from then on it gets what is broadcast.
  void Join(const std::shared_ptr<LiveSession>& session);
  /// Its connection has ended.
  void Leave(const std::shared_ptr<LiveSession>& session);
  void Broadcast(const LiveFrame& frame);
  /// A text from a browser: a command, or about who may command. Whatever is wrong with it is told in an
  /// "ack".
  void Hear(const std::shared_ptr<LiveSession>& session, const std::string& text);
  /// Why who has this token may not command, "" when he may.
  std::string WhyNot(const std::string& token) const { return desk_.WhyNot(desk_.Who(token)); }
  /// To be called a few times a second: people who are waited for.
  void Look();

  static constexpr int kMaxWaitingCommands = 16;  ///< of one browser

 private:
  void Command(const std::shared_ptr<LiveSession>& session, nlohmann::json message);
  void Control(const std::shared_ptr<LiveSession>& session, nlohmann::json message);
  CommandResult Decide(const std::shared_ptr<LiveSession>& session, const nlohmann::json& message);
  void Introduce(const std::shared_ptr<LiveSession>& session, const Introduction& introduction);
  void TellControl();
  LiveFrame ControlFrame(const LiveSession& session) const;

  Backend backend_;
  ControlDesk desk_;
  std::optional<KeptHolder> kept_;  ///< the holder as the backend knows him
  std::vector<std::weak_ptr<LiveSession>> sessions_;
};

}  // namespace skein::bridge

#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bridge/command_gateway.h"
#include "bridge/control_desk.h"
#include "bridge/history_query.h"
#include "bridge/live_frame.h"
#include "bridge/previewer.h"

namespace skein::bridge {

/// What the web server asks of the bus side. It calls these on its own thread, and `reply` comes later on
/// that same thread (WebBridge sees to both), or never when the bridge ends first.
struct Backend {
  template <typename Result>
  using Reply = std::function<void(const Result&)>;

  /// Why nobody may command or fly changes ahead, whoever he is; "": they may.
  std::string why_no_command;
  /// hello and the last of everything, for a browser that has just come.
  std::function<void(Reply<std::vector<LiveFrame>>)> snapshot;
  /// The JSON of GET /api/health, of GET /api/state and of GET /api/vehicles.
  std::function<void(Reply<std::string>)> health;
  std::function<void(Reply<std::string>)> state;
  std::function<void(Reply<std::string>)> vehicles;
  /// The bytes of GET /api/history.
  std::function<void(HistoryQuery, Reply<std::string>)> history;
  /// An EVENT of the bridge itself.
  std::function<void(std::string code, std::string text)> tell;
  /// Who holds control from now on, for a bridge that is started anew.
  std::function<void(std::optional<KeptHolder>)> keep_holder;
  std::function<void(std::string channel, nlohmann::json body, Reply<CommandResult>)> command;
  std::function<void(PreviewRequest, Previewer::Gone, Reply<PreviewReply>)> preview;
};

}  // namespace skein::bridge

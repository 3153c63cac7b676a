#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "bridge/command_gateway.h"
#include "bridge/live_frame.h"

namespace skein::playback {

/// What somebody at the page wants of a player.
struct PlaybackRequest {
  enum class Action { kPlay, kPause, kSeek, kStep, kSpeed, kLoop };
  nlohmann::json id;  ///< text or number, null: none
  Action action = Action::kPlay;
  double t_s = 0;
  int steps = 1;
  double speed = 1;
  std::optional<std::pair<double, double>> loop_s;
};

/// Reads a text from the browser. Throws config::ConfigError, with the field and what is wrong with it.
PlaybackRequest ParsePlaybackRequest(const nlohmann::json& message);

/// The "id" of a message when it has a good one, else null.
nlohmann::json IdOf(const nlohmann::json& message);

}  // namespace skein::playback

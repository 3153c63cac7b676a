#include "playback/playback_request.h"

#include <cmath>
#include <map>

#include "bridge/names_in.h"
#include "config/json_reader.h"
#include "playback/player.h"

namespace skein::playback {
namespace {

using Action = PlaybackRequest::Action;

constexpr double kLongest_s = 1e9;
constexpr int kMostSteps = 100'000;

std::optional<std::pair<double, double>> ParseLoop(const config::Value& value) {
  const auto ends = value.Items();
  if (ends.size() != 2) value.Refuse("must be [a_s, b_s] or null");
  const double a_s = ends[0].Number({0, kLongest_s});
  const double b_s = ends[1].Number({0, kLongest_s});
  if (b_s < a_s + Player::kShortestLoop_s) value.Refuse("must end at least 0.2 s after it begins");
  return std::pair(a_s, b_s);
}

double ParseSpeed(const config::Value& value) {
  const double speed = value.Number({-Player::kFastest, Player::kFastest});
  if (std::abs(speed) < Player::kSlowest) value.Refuse("must be 0.1 to 50, or -0.1 to -50: backwards");
  return speed;
}

}  // namespace

nlohmann::json IdOf(const nlohmann::json& message) {
  const auto id = message.is_object() ? message.find("id") : message.end();
  if (!message.is_object() || id == message.end()) return {};
  return id->is_string() || id->is_number() ? *id : nlohmann::json();
}

PlaybackRequest ParsePlaybackRequest(const nlohmann::json& message) {
  static const std::map<std::string, Action> kActions = {
      {"play", Action::kPlay}, {"pause", Action::kPause}, {"seek", Action::kSeek},
      {"step", Action::kStep}, {"speed", Action::kSpeed}, {"loop", Action::kLoop},
  };
  const config::Object object(config::Value::FromJson(message, "playback"),
                              {"type", "id", "action", "t_s", "steps", "speed", "loop"});
  PlaybackRequest request;
  request.id = IdOf(message);
  const config::Value action = object.At("action");
  const auto known = kActions.find(action.Text());
  if (known == kActions.end()) action.Refuse("must be " + bridge::NamesIn(kActions));
  request.action = known->second;
  switch (request.action) {
    case Action::kSeek:
      request.t_s = object.At("t_s").Number({-kLongest_s, kLongest_s});
      break;
    case Action::kStep:
      if (object.Has("steps")) request.steps = object.At("steps").Integer({-kMostSteps, kMostSteps});
      break;
    case Action::kSpeed:
      request.speed = ParseSpeed(object.At("speed"));
      break;
    case Action::kLoop:
      if (!message.contains("loop") || !message["loop"].is_null())
        request.loop_s = ParseLoop(object.At("loop"));
      break;
    case Action::kPlay:
    case Action::kPause:
      break;
  }
  return request;
}

}  // namespace skein::playback

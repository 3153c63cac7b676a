#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>

#include "bridge/bus_mirror.h"
#include "playback/playback_request.h"
#include "playback/player.h"
#include "playback/recording_library.h"

namespace skein::playback {

/// One browser that looks at a recording: opens it, and plays it as the browser says. Run() is for a thread
/// of its own, Hear() for any.
class Viewer {
 public:
  using Send = std::function<void(const bridge::LiveFrame&)>;

  Viewer(RecordingLibrary& library, std::string name, bridge::HelloInfo hello, Send send);

  /// Until `stop`.
  void Run(const std::stop_token& stop);

  /// A text from the browser. What is wrong with it is told in an "ack" at once.
  void Hear(const std::string& text);

 private:
  std::shared_ptr<const RecordedFlight> OpenFlight(const std::stop_token& stop);
  void Obey(Player& player, const PlaybackRequest& request);
  void SayHello();
  void Acknowledge(const nlohmann::json& id, const std::string& problem);
  std::deque<PlaybackRequest> TakeRequests(const std::stop_token& stop, double wait_s);

  RecordingLibrary& library_;
  std::string name_;
  bridge::HelloInfo hello_;
  Send send_;
  std::mutex mutex_;
  std::condition_variable_any heard_;
  std::deque<PlaybackRequest> requests_;

  static constexpr std::size_t kMostWaiting = 1000;
};

}  // namespace skein::playback

#include "playback/viewer.h"

#include <chrono>
#include <iterator>
#include <utility>

#include "config/json_reader.h"

namespace skein::playback {
namespace {

using Action = PlaybackRequest::Action;
using Clock = std::chrono::steady_clock;

constexpr double kTellProgress_s = 0.1;
constexpr double kForever_s = 3600;

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

Viewer::Viewer(RecordingLibrary& library, std::string name, bridge::HelloInfo hello, Send send)
    : library_(library), name_(std::move(name)), hello_(std::move(hello)), send_(std::move(send)) {}

void Viewer::Hear(const std::string& text) {
  const auto message = config::ParseJson(text);
  const nlohmann::json id = IdOf(message);
  if (!message.is_object() || message.value("type", nlohmann::json()) != "playback") {
    return Acknowledge(id, "this is a recording: it can be played, but nothing can be commanded");
  }
  if (id.is_null()) return Acknowledge(id, "id: must be a text or a number");
  try {
    PlaybackRequest request = ParsePlaybackRequest(message);
    const std::lock_guard lock(mutex_);
    if (requests_.size() >= kMostWaiting) return Acknowledge(id, "too many requests wait");
    requests_.push_back(std::move(request));
    heard_.notify_one();
  } catch (const config::ConfigError& error) {
    Acknowledge(id, error.what());
  }
}

void Viewer::Acknowledge(const nlohmann::json& id, const std::string& problem) {
  bridge::LiveFrame frame = bridge::TextFrame(bridge::Dump({{"type", "ack"},
                                                            {"id", bridge::Json(id)},
                                                            {"channel", "playback"},
                                                            {"accepted", problem.empty()},
                                                            {"reason", problem}}));
  frame.answer = true;
  send_(frame);
}

std::deque<PlaybackRequest> Viewer::TakeRequests(const std::stop_token& stop, double wait_s) {
  std::unique_lock lock(mutex_);
  heard_.wait_for(lock, stop, std::chrono::duration<double>(wait_s), [this] { return !requests_.empty(); });
  return std::exchange(requests_, {});
}

void Viewer::SayHello() {
  const Stage nothing(0, hello_, [](const bridge::LiveFrame&) {});
  send_(nothing.mirror().Snapshot().front());
}

std::shared_ptr<const RecordedFlight> Viewer::OpenFlight(const std::stop_token& stop) {
  for (double told = -1; !stop.stop_requested();) {
    const auto opened = library_.Open(name_);
    if (!opened || !opened->problem.empty()) {
      send_(OpeningFrame(0, opened ? opened->problem : "it is no longer there"));
      return nullptr;
    }
    if (opened->flight) return opened->flight;
    if (opened->progress != told) send_(OpeningFrame(opened->progress, ""));
    told = opened->progress;
    std::unique_lock lock(mutex_);
    heard_.wait_for(lock, stop, std::chrono::duration<double>(kTellProgress_s), [] { return false; });
  }
  return nullptr;
}

void Viewer::Run(const std::stop_token& stop) {
  SayHello();
  const auto flight = OpenFlight(stop);
  if (!flight) {
    while (!stop.stop_requested()) {
      for (const PlaybackRequest& request : TakeRequests(stop, kForever_s)) {
        Acknowledge(request.id, "the recording could not be opened");
      }
    }
    return;
  }
  Player player(flight, hello_, send_);
  for (auto before = Clock::now(); !stop.stop_requested();) {
    const double busy_s = Seconds(Clock::now() - before);
    const auto requests =
        TakeRequests(stop, player.playing() ? std::max(0.0, Player::kPeriod_s - busy_s) : kForever_s);
    const auto now = Clock::now();
    player.Advance(Seconds(now - std::exchange(before, now)));
    for (auto request = requests.begin(); request != requests.end(); ++request) {
      // Whoever drags the time line asks for more than can be shown.
      const auto next = std::next(request);
      const bool overtaken =
          request->action == Action::kSeek && next != requests.end() && next->action == Action::kSeek;
      if (!overtaken) Obey(player, *request);
      Acknowledge(request->id, "");
    }
  }
}

void Viewer::Obey(Player& player, const PlaybackRequest& request) {
  switch (request.action) {
    case Action::kPlay:
      return player.Play();
    case Action::kPause:
      return player.Pause();
    case Action::kSeek:
      return player.Seek(request.t_s);
    case Action::kStep:
      return player.Step(request.steps);
    case Action::kSpeed:
      return player.SetSpeed(request.speed);
    case Action::kLoop:
      return player.SetLoop(request.loop_s);
  }
}

}  // namespace skein::playback

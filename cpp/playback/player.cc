#include "playback/player.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace skein::playback {
namespace {

using bridge::Json;

constexpr double kStep_s = 0.05;
constexpr double kTellPeriod_s = 0.25;
// Played backwards, every picture is a jump.
constexpr double kJumpPeriod_s = 0.2;
// A process that was held up does not make up for it in one leap.
constexpr double kLongestElapsed_s = 0.25;
// Above this speed the stage leaves things out.
constexpr double kFast = 2;

bridge::LiveFrame PlaybackFrame(Json message) { return bridge::TextFrame(bridge::Dump(message), "playback"); }

}  // namespace

bridge::LiveFrame OpeningFrame(double progress, const std::string& problem) {
  return PlaybackFrame({{"type", "playback"},
                        {"state", problem.empty() ? "opening" : "failed"},
                        {"t_s", 0},
                        {"duration_s", 0},
                        {"start_utime", 0},
                        {"speed", 1},
                        {"direction", 1},
                        {"loop", nullptr},
                        {"progress", progress},
                        {"problem", problem}});
}

Player::Player(std::shared_ptr<const RecordedFlight> flight, bridge::HelloInfo hello, Sink sink)
    : flight_(std::move(flight)), hello_(std::move(hello)), sink_(std::move(sink)) {
  Jump(0);
  Tell();
}

void Player::Play() {
  if (state_ == State::kPlaying) return;
  if (state_ == State::kEnded) {
    if (speed_ > 0 && t_s_ >= duration_s()) Jump(0);
    if (speed_ < 0 && t_s_ <= 0) Jump(duration_s());
  }
  state_ = State::kPlaying;
  Tell();
}

void Player::Pause() {
  if (state_ == State::kPlaying) {
    state_ = State::kPaused;
    // What was left out in fast motion is to be seen now.
    if (speed_ > kFast) Jump(t_s_);
    TellMoment();
  }
  Tell();
}

void Player::Seek(double t_s) {
  Jump(std::clamp(t_s, 0.0, duration_s()));
  if (state_ == State::kEnded) state_ = State::kPaused;
  Tell();
}

void Player::Step(int steps) {
  state_ = State::kPaused;
  const double to_s = std::clamp(t_s_ + steps * kStep_s, 0.0, duration_s());
  if (steps == 1) {
    t_s_ = to_s;
    stage_->PlayUntil(Utime(t_s_));
    TellMoment();
  } else {
    Jump(to_s);
  }
  Tell();
}

void Player::SetSpeed(double speed) {
  const bool was_fast = playing() && speed_ > kFast;
  speed_ = speed;
  if (was_fast && speed_ > 0 && speed_ <= kFast) Jump(t_s_);
  Tell();
}

void Player::SetLoop(std::optional<std::pair<double, double>> loop_s) {
  loop_s_ = loop_s;
  if (loop_s_) {
    loop_s_->second = std::min(loop_s_->second, duration_s());
    loop_s_->first = std::clamp(loop_s_->first, 0.0, std::max(0.0, loop_s_->second - kShortestLoop_s));
  }
  Tell();
}

void Player::Advance(double elapsed_s) {
  if (!playing()) return;
  elapsed_s = std::clamp(elapsed_s, 0.0, kLongestElapsed_s);
  if (speed_ > 0) {
    PlayOn(speed_ * elapsed_s);
  } else {
    PlayBack(-speed_ * elapsed_s, elapsed_s);
  }
  since_told_s_ += elapsed_s;
  if (playing() && since_told_s_ >= kTellPeriod_s) Tell();
}

void Player::PlayOn(double step_s) {
  const double to_s = t_s_ + step_s;
  // A loop counts for who is in it or before it; behind it one plays on to the end.
  if (loop_s_ && t_s_ <= loop_s_->second && to_s >= loop_s_->second) return Jump(loop_s_->first);
  t_s_ = std::min(to_s, duration_s());
  stage_->PlayUntil(Utime(t_s_));
  if (t_s_ >= duration_s()) End(duration_s());
}

void Player::PlayBack(double step_s, double elapsed_s) {
  t_s_ -= step_s;
  since_jump_s_ += elapsed_s;
  if (loop_s_ && t_s_ <= loop_s_->first && t_s_ + step_s >= loop_s_->first) return Jump(loop_s_->second);
  if (t_s_ <= 0) return End(0);
  // Not more often than this machine can.
  if (since_jump_s_ >= std::max(kJumpPeriod_s, 2 * jump_took_s_)) Jump(t_s_);
}

void Player::End(double t_s) {
  state_ = State::kEnded;
  Jump(t_s);
  Tell();
}

void Player::Jump(double t_s) {
  const auto began = std::chrono::steady_clock::now();
  t_s_ = t_s;
  since_jump_s_ = 0;
  stage_ = Stage::At(*flight_, Utime(t_s_), hello_, sink_);
  sink_(bridge::ResetFrame());
  for (const bridge::LiveFrame& frame : stage_->mirror().Snapshot()) sink_(frame);
  jump_took_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void Player::TellMoment() {
  sink_(stage_->mirror().Motion());
  sink_(stage_->mirror().Status());
}

void Player::Tell() {
  since_told_s_ = 0;
  const char* const states[] = {"paused", "playing", "ended"};
  Json loop = nullptr;
  if (loop_s_) loop = Json::array({loop_s_->first, loop_s_->second});
  sink_(PlaybackFrame({{"type", "playback"},
                       {"state", states[static_cast<int>(state_)]},
                       {"t_s", t_s_},
                       {"duration_s", duration_s()},
                       {"start_utime", flight_->start()},
                       {"speed", std::abs(speed_)},
                       {"direction", speed_ < 0 ? -1 : 1},
                       {"loop", loop},
                       {"progress", 1},
                       {"problem", ""}}));
}

}  // namespace skein::playback

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bridge/bus_mirror.h"
#include "bridge/live_frame.h"
#include "playback/recorded_flight.h"
#include "playback/stage.h"

namespace skein::playback {

/// Plays a recording to one browser: forwards, backwards, fast, slowly, in a loop. Told how much time has
/// gone by, it never looks at a clock.
class Player {
 public:
  using Sink = bridge::BusMirror::Sink;

  /// Shows the beginning at once, paused.
  Player(std::shared_ptr<const RecordedFlight> flight, bridge::HelloInfo hello, Sink sink);

  /// At the end (backwards: at the beginning) it begins again from the other one.
  void Play();
  void Pause();
  /// Beyond either end: there.
  void Seek(double t_s);
  /// By so many periods of FLEET_STATE, and pauses.
  void Step(int steps);
  /// @param speed kSlowest to kFastest, or the same negative: backwards.
  void SetSpeed(double speed);
  /// Plays from a_s to b_s again and again; none: no more.
  void SetLoop(std::optional<std::pair<double, double>> loop_s);

  /// So much time has gone by since the last call.
  void Advance(double elapsed_s);

  bool playing() const { return state_ == State::kPlaying; }
  double t_s() const { return t_s_; }
  double duration_s() const { return flight_->duration_s(); }

  static constexpr double kSlowest = 0.1;
  static constexpr double kFastest = 50;
  static constexpr double kShortestLoop_s = 0.2;
  /// While it plays, Advance() is to be called so often.
  static constexpr double kPeriod_s = 0.05;

 private:
  enum class State { kPaused, kPlaying, kEnded };

  bus::Utime Utime(double t_s) const { return flight_->start() + bus::ToUtime(t_s); }
  void PlayOn(double step_s);
  void PlayBack(double step_s, double elapsed_s);
  void Jump(double t_s);
  void End(double t_s);
  void TellMoment();
  void Tell();

  std::shared_ptr<const RecordedFlight> flight_;
  bridge::HelloInfo hello_;
  Sink sink_;
  std::unique_ptr<Stage> stage_;
  State state_ = State::kPaused;
  double t_s_ = 0;
  double speed_ = 1;  ///< negative: backwards
  std::optional<std::pair<double, double>> loop_s_;
  double since_told_s_ = 0;
  double since_jump_s_ = 0;
  double jump_took_s_ = 0;
};

/// The message "playback" of a recording that is not open: "opening", or "failed" with a problem.
bridge::LiveFrame OpeningFrame(double progress, const std::string& problem);

}  // namespace skein::playback

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>

#include "core/link_watch.h"

namespace skein::testing {

struct TrialLink {
  double delay_s = 0;
  double jitter_s = 0;
  double loss = 0;
};

enum class Fault { kSilentBoth, kSilentDown, kSilentUp, kFrozen, kFrozenWithNewStamps };

/// A UAV that circles, its data link, a station that commands it at 20 Hz and checks the link at 10 Hz: all
/// in steps of 5 ms on a simulated clock.
class LinkTrial {
 public:
  static constexpr std::int64_t kStep = 5'000;
  static constexpr std::int64_t kTick = 50'000;
  static constexpr std::int64_t kCheck = 100'000;
  static constexpr std::int64_t kStart = 1'577'836'800'000'000;

  TrialLink link;
  Fault fault = Fault::kSilentBoth;
  std::int64_t cut_at = std::numeric_limits<std::int64_t>::max();      ///< [us] since the start
  std::int64_t restore_at = std::numeric_limits<std::int64_t>::max();  ///< [us] since the start
  std::int64_t tick_phase = 0;
  std::int64_t command_phase = 0;
  std::int64_t check_phase = 0;
  bool commanded = true;
  unsigned seed = 1;

  LinkWatch watch{kStart};

  // What was seen.
  std::optional<std::int64_t> late_at;  ///< first time that a direction was late, since the start
  std::optional<std::int64_t> lost_at;  ///< first time that a direction was lost
  std::optional<std::int64_t> up_at;    ///< first time after the last restoration that both were up again
  int times_lost = 0;

  void RunUntil(std::int64_t end) {
    std::mt19937 random(seed);
    for (std::int64_t t = 0; t <= end; t += kStep) {
      const bool cut = t >= cut_at && t < restore_at;
      if (t % kTick == command_phase % kTick && commanded) SendCommand(t, cut, random);
      while (!commands_.empty() && commands_.begin()->first <= t) {
        obeyed_ = std::max(obeyed_, commands_.begin()->second);
        commands_.erase(commands_.begin());
      }
      if (t % kTick == tick_phase % kTick) SendTelemetry(t, cut, random);
      while (!telemetry_.empty() && telemetry_.begin()->first <= t) {
        watch.Hear(kStart + t, telemetry_.begin()->second);
        telemetry_.erase(telemetry_.begin());
      }
      if (t % kCheck == check_phase % kCheck) Check(t);
    }
  }

 private:
  static constexpr std::int64_t kSession = 77;

  Telemetry Now(std::int64_t t) const {
    // 50 m/s on a circle of 500 m radius.
    const double angle = 0.1 * static_cast<double>(t) * 1e-6;
    Telemetry telemetry;
    telemetry.utime = kStart + t;
    telemetry.state.east_m = 500 * std::sin(angle);
    telemetry.state.north_m = -500 * std::cos(angle);
    telemetry.state.up_m = 1000;
    telemetry.state.speed_m_s = 50;
    telemetry.state.course_rad = angle;
    telemetry.command_session_id = obeyed_ > 0 ? kSession : 0;
    telemetry.command_sequence = obeyed_;
    return telemetry;
  }

  std::int64_t Arrival(std::int64_t t, std::mt19937& random) const {
    const double way_s = link.delay_s + link.jitter_s * std::uniform_real_distribution<double>()(random);
    return t + static_cast<std::int64_t>(way_s * 1e6);
  }
  bool Lose(std::mt19937& random) const {
    return std::uniform_real_distribution<double>()(random) < link.loss;
  }

  void SendCommand(std::int64_t t, bool cut, std::mt19937& random) {
    watch.Command(kStart + t, kSession);
    ++sent_;
    const bool lost = Lose(random) || (cut && fault != Fault::kSilentDown);
    if (!lost) commands_.emplace(Arrival(t, random), sent_);
  }

  void SendTelemetry(std::int64_t t, bool cut, std::mt19937& random) {
    if (!cut || fault == Fault::kSilentUp) {
      frozen_ = Now(t);
    } else if (fault == Fault::kFrozenWithNewStamps) {
      frozen_.utime = kStart + t;
    } else if (fault != Fault::kFrozen) {
      return;
    }
    if (!Lose(random)) telemetry_.emplace(Arrival(t, random), frozen_);
  }

  void Check(std::int64_t t) {
    const bool was_lost = watch.lost();
    watch.Check(kStart + t);
    const bool late = watch.downlink() == LinkState::kLate || watch.uplink() == LinkState::kLate;
    if (late && !late_at) late_at = t;
    if (watch.lost() && !was_lost) ++times_lost;
    if (watch.lost() && !lost_at) lost_at = t;
    if (t >= restore_at && !watch.lost() && !up_at) up_at = t;
  }

  std::int64_t sent_ = 0;
  std::int64_t obeyed_ = 0;
  Telemetry frozen_;
  std::multimap<std::int64_t, std::int64_t> commands_;
  std::multimap<std::int64_t, Telemetry> telemetry_;
};

}  // namespace skein::testing

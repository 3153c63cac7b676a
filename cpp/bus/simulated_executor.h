#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "bus/executor.h"
#include "bus/timer_queue.h"

namespace skein::bus {

/// Runs nodes that share one memq transport on a simulated clock, as fast as it can and the same way every
/// time: after each timer all messages are delivered, and those that they cause, before the next timer runs.
class SimulatedExecutor : public Executor {
 public:
  /// 2020-01-01 00:00 UTC.
  static constexpr Utime kStart = 1'577'836'800'000'000;

  /// @param transport of "memq://", not null.
  explicit SimulatedExecutor(std::shared_ptr<lcm::LCM> transport, Utime start = kStart);

  Utime Now() const override { return now_; }
  Utime WallAhead() const override { return wall_ahead_; }
  void Every(Utime period, std::function<void()> callback, Utime phase = 0) override;
  void At(Utime when, std::function<void()> callback) override;

  /// As if somebody had set the wall clock.
  void SetWallAhead(Utime ahead) { wall_ahead_ = ahead; }

  /// Delivers what is queued, then runs everything that is due up to `utime`, that moment included; it is
  /// `utime` after.
  void RunUntil(Utime utime);
  /// Delivers what is queued; it is `utime` then, and timers that were due meanwhile run once, late, in the
  /// next RunUntil.
  void SkipTo(Utime utime);
  void RunFor(Utime duration) { RunUntil(now_ + duration); }

  /// Delivers queued messages until there are none.
  void Deliver();

 private:
  std::shared_ptr<lcm::LCM> transport_;
  Utime now_;
  Utime wall_ahead_ = 0;
  TimerQueue timers_;
};

}  // namespace skein::bus

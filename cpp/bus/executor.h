#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace skein::bus {

/// Microseconds since 1970, as everywhere on the bus.
using Utime = std::int64_t;

inline constexpr Utime kSecond = 1'000'000;

/// The phase of what can wait while a tick of FLEET_STATE and its answer fill the bus: fleet-simulator's
/// ticks are at whole multiples of 50 ms.
inline constexpr Utime kBetweenTicks = 25'000;

inline constexpr Utime ToUtime(double seconds) {
  return static_cast<Utime>(seconds * 1e6 + (seconds < 0 ? -0.5 : 0.5));
}
inline constexpr double ToSeconds(Utime utime) { return static_cast<double>(utime) * 1e-6; }

/// Gives a node its time and its timers, so that the very same node runs live, in tests and in
/// flight-experiment. All callbacks run on the one thread that runs the executor, never at the same time as a
/// message handler.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Live: the time of this host's Skein (bus/host_clock.h). Simulated: the simulated time.
  virtual Utime Now() const = 0;

  /// How far the wall clock is ahead of Now(), because it was set.
  virtual Utime WallAhead() const { return 0; }

  /// Calls `callback` at phase + n * period for every n that lies in the future; a late one is called once,
  /// not made up for.
  virtual void Every(Utime period, std::function<void()> callback, Utime phase = 0) = 0;

  /// Calls `callback` once, at `when` or, if that has passed, as soon as it can. Same time: in the order of
  /// the calls.
  virtual void At(Utime when, std::function<void()> callback) = 0;

  /// Called in the midst of a long burst of messages. Live: sleeps a moment, so that receivers can empty
  /// their buffers.
  virtual void PauseBurst() {}
};

}  // namespace skein::bus

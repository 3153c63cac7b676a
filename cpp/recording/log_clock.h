#pragma once

#include <algorithm>
#include <optional>

#include "bus/executor.h"

namespace skein::recording {

/// The time stamps of a log, put right so that they always rise: where the wall clock was set back, or leapt
/// by more than a day (a damaged stamp does), time goes on from where it was.
class LogClock {
 public:
  LogClock() = default;
  /// Goes on from a place that was read before: the time there and the shift().
  LogClock(bus::Utime time, bus::Utime shift) : last_(time), shift_(shift) {}

  /// The time of the next event, by its stamp.
  bus::Utime Read(bus::Utime stamp) {
    stamp = std::clamp(stamp, bus::Utime{0}, kLargest);
    bus::Utime time = stamp + shift_;
    if (last_ && (time < *last_ - bus::kSecond || time > *last_ + kLongestPause)) {
      shift_ = *last_ - stamp;
      time = *last_;
    }
    last_ = std::max(time, last_.value_or(time));
    return *last_;
  }

  /// Added to stamps; it changes where they leap.
  bus::Utime shift() const { return shift_; }

 private:
  static constexpr bus::Utime kLargest = bus::Utime{1} << 61;
  static constexpr bus::Utime kLongestPause = 86'400 * bus::kSecond;

  std::optional<bus::Utime> last_;
  bus::Utime shift_ = 0;
};

}  // namespace skein::recording

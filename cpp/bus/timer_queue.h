#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "bus/executor.h"

namespace skein::bus {

/// The timers of an executor, in order of time; at the same time in the order in which they were set.
class TimerQueue {
 public:
  void Every(Utime now, Utime period, std::function<void()> callback, Utime phase);
  void At(Utime when, std::function<void()> callback);

  /// When the first timer is due.
  std::optional<Utime> Next() const;

  /// Runs the first timer if it is due. Returns whether one ran.
  bool RunOne(Utime now);

 private:
  struct Timer {
    std::function<void()> callback;
    Utime period = 0;  ///< 0: once
    Utime phase = 0;
  };

  std::map<std::pair<Utime, std::int64_t>, Timer> timers_;  ///< by time and order of creation
  std::int64_t created_ = 0;
};

}  // namespace skein::bus

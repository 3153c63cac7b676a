#pragma once

#include "bus/executor.h"

namespace skein::monitor {

/// Whether this process itself was stopped, or starved, so that the silence of others proves nothing yet:
/// what they said waits unread, or was dropped by a full buffer.
class HeldUp {
 public:
  /// Nobody who looks several times a second is so late otherwise.
  static constexpr bus::Utime kHeldUp = bus::kSecond;

  /// @param listen for how long to listen afterwards before judging [us].
  explicit HeldUp(bus::Utime listen) : listen_(listen) {}

  /// To be asked at each look. @return whether it is too early to judge.
  bool MustListen(bus::Utime now) {
    if (looked_ != 0 && now - looked_ > kHeldUp) until_ = now + listen_;
    looked_ = now;
    return now < until_;
  }

 private:
  bus::Utime listen_;
  bus::Utime looked_ = 0;
  bus::Utime until_ = 0;
};

}  // namespace skein::monitor

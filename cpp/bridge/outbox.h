#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "bridge/live_frame.h"

namespace skein::bridge {

/// What waits to be sent to one browser. A browser that is slow skips: a frame takes the place of one with
/// the same key that still waits, so that it gets the newest, and every key has its turn. Frames without a
/// key are never dropped, unless a reset comes behind them.
class Outbox {
 public:
  /// False, and nothing is kept, when more than kMaxBytes would wait: this browser cannot follow.
  bool Push(LiveFrame frame);

  /// The frame whose turn it is.
  std::optional<LiveFrame> Pop();

  std::size_t waiting_bytes() const { return waiting_bytes_; }

  static constexpr std::size_t kMaxBytes = 4u << 20;

 private:
  std::deque<LiveFrame> frames_;
  std::size_t waiting_bytes_ = 0;
};

}  // namespace skein::bridge

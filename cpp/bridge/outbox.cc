#include "bridge/outbox.h"

#include <algorithm>

namespace skein::bridge {

bool Outbox::Push(LiveFrame frame) {
  if (frame.resets) {
    std::erase_if(frames_, [this](const LiveFrame& other) {
      if (!other.answer) waiting_bytes_ -= other.bytes->size();
      return !other.answer;
    });
  }
  const std::size_t size = frame.bytes->size();
  const auto same = frame.key.empty()
                        ? frames_.end()
                        : std::find_if(frames_.begin(), frames_.end(),
                                       [&](const LiveFrame& other) { return other.key == frame.key; });
  const std::size_t replaced = same == frames_.end() ? 0 : same->bytes->size();
  if (waiting_bytes_ - replaced + size > kMaxBytes) return false;
  waiting_bytes_ = waiting_bytes_ - replaced + size;
  if (same == frames_.end()) {
    frames_.push_back(std::move(frame));
  } else {
    *same = std::move(frame);
  }
  return true;
}

std::optional<LiveFrame> Outbox::Pop() {
  if (frames_.empty()) return std::nullopt;
  LiveFrame frame = std::move(frames_.front());
  frames_.pop_front();
  waiting_bytes_ -= frame.bytes->size();
  return frame;
}

}  // namespace skein::bridge

#include "bus/timer_queue.h"

#include <cassert>

namespace skein::bus {
namespace {

/// The first phase + n * period after `now`.
Utime NextBeat(Utime now, Utime period, Utime phase) {
  const Utime since = (now - phase) % period;
  return now - since + (since < 0 ? 0 : period);
}

}  // namespace

void TimerQueue::Every(Utime now, Utime period, std::function<void()> callback, Utime phase) {
  assert(period > 0);
  timers_.emplace(std::pair(NextBeat(now, period, phase), created_++),
                  Timer{std::move(callback), period, phase});
}

void TimerQueue::At(Utime when, std::function<void()> callback) {
  timers_.emplace(std::pair(when, created_++), Timer{std::move(callback)});
}

std::optional<Utime> TimerQueue::Next() const {
  return timers_.empty() ? std::nullopt : std::optional(timers_.begin()->first.first);
}

bool TimerQueue::RunOne(Utime now) {
  if (timers_.empty() || timers_.begin()->first.first > now) return false;
  auto node = timers_.extract(timers_.begin());
  if (node.mapped().period == 0) {
    node.mapped().callback();
    return true;
  }
  // Put back before it runs, so that a callback that throws does not end its timer.
  const std::function<void()> callback = node.mapped().callback;
  node.key().first = NextBeat(now, node.mapped().period, node.mapped().phase);
  timers_.insert(std::move(node));
  callback();
  return true;
}

}  // namespace skein::bus

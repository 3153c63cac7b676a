#include "bus/simulated_executor.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace skein::bus {

SimulatedExecutor::SimulatedExecutor(std::shared_ptr<lcm::LCM> transport, Utime start)
    : transport_(std::move(transport)), now_(start) {
  assert(transport_ && transport_->good());
}

void SimulatedExecutor::Every(Utime period, std::function<void()> callback, Utime phase) {
  timers_.Every(now_, period, std::move(callback), phase);
}

void SimulatedExecutor::At(Utime when, std::function<void()> callback) {
  timers_.At(when, std::move(callback));
}

void SimulatedExecutor::Deliver() {
  // handleTimeout(0) would ask by select() before each message, a sixth of the time of a small flight.
  for (int waiting = 0; ioctl(transport_->getFileno(), FIONREAD, &waiting) == 0 && waiting > 0;) {
    transport_->handle();
  }
}

void SimulatedExecutor::RunUntil(Utime utime) {
  assert(utime >= now_);
  Deliver();
  for (auto next = timers_.Next(); next && *next <= utime; next = timers_.Next()) {
    now_ = std::max(now_, *next);
    timers_.RunOne(now_);
    Deliver();
  }
  now_ = utime;
}

void SimulatedExecutor::SkipTo(Utime utime) {
  assert(utime >= now_);
  Deliver();
  now_ = utime;
}

}  // namespace skein::bus

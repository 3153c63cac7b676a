#pragma once

#include <atomic>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "bus/executor.h"
#include "bus/host_clock.h"
#include "bus/timer_queue.h"

namespace skein::bus {

/// Blocks SIGINT and SIGTERM in this thread and all that it starts, so that LiveExecutor gets them. Call it
/// before anything starts a thread (LCM does). NodeMain and the constructor of LiveExecutor call it.
void BlockEndSignals();

/// Runs a node live: one thread, in which messages, timers and whatever was posted run one after the other.
class LiveExecutor : public Executor {
 public:
  /// @param transport whose messages it handles, not null.
  explicit LiveExecutor(std::shared_ptr<lcm::LCM> transport);
  ~LiveExecutor() override;
  LiveExecutor(const LiveExecutor&) = delete;
  LiveExecutor& operator=(const LiveExecutor&) = delete;

  /// The time of this host's Skein (bus/host_clock.h): a wall clock that is set moves nothing.
  Utime Now() const override { return clock_.Now(); }
  Utime WallAhead() const override { return clock_.WallAhead(); }
  void Every(Utime period, std::function<void()> callback, Utime phase = 0) override;
  void At(Utime when, std::function<void()> callback) override;
  void PauseBurst() override;

  /// Has `callback` run on the executor's thread. The only functions here for other threads: this and Stop().
  void Post(std::function<void()> callback);

  /// Calls `callback` whenever `fd` is readable, until Unwatch. One callback for each fd.
  void Watch(int fd, std::function<void()> callback);
  void Unwatch(int fd);

  /// Until Stop(), SIGINT or SIGTERM. Throws std::runtime_error when the transport breaks (a hub that went
  /// away).
  void Run();
  void Stop();

 private:
  void HandleMessages();
  void RunPosted();

  std::shared_ptr<lcm::LCM> transport_;
  const HostClock& clock_;
  int wake_fd_;
  int signal_fd_;
  std::atomic<bool> stop_ = false;
  TimerQueue timers_;
  std::map<int, std::function<void()>> watched_;
  std::mutex posted_mutex_;
  std::vector<std::function<void()>> posted_;
};

}  // namespace skein::bus

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace skein::bridge {

/// A thread of its own for work that takes long: one job after the other, in the order in which they came,
/// after the threads that fly and show (a nice value above theirs).
class JobThread {
 public:
  /// Ends early when its stop token says so.
  using Job = std::function<void(std::stop_token)>;

  explicit JobThread(std::size_t most_waiting);
  /// Stops the job that runs and drops those that wait.
  ~JobThread();
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// From any thread. @return false when too many wait: the job is not taken.
  bool Add(Job job);

 private:
  void Run(const std::stop_token& stop);

  std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable_any added_;
  std::deque<Job> waiting_;
  std::jthread thread_;  ///< last: it ends before what it uses
};

}  // namespace skein::bridge

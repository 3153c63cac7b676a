#include "bridge/job_thread.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace skein::bridge {
namespace {

// Linux has a nice value for each thread.
constexpr int kNice = 10;

}  // namespace

JobThread::JobThread(std::size_t most_waiting)
    : most_waiting_(most_waiting), thread_([this](const std::stop_token& stop) { Run(stop); }) {}

JobThread::~JobThread() {
  thread_.request_stop();
  thread_.join();
}

bool JobThread::Add(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= most_waiting_) return false;
    waiting_.push_back(std::move(job));
  }
  added_.notify_one();
  return true;
}

void JobThread::Run(const std::stop_token& stop) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  for (;;) {
    std::unique_lock lock(mutex_);
    if (!added_.wait(lock, stop, [this] { return !waiting_.empty(); }) || stop.stop_requested()) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    job(stop);
  }
}

}  // namespace skein::bridge

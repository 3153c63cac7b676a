#include "bus/live_executor.h"

#include <poll.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace skein::bus {
namespace {

// Long enough for other processes to get a turn on a busy machine, short against a tick.
constexpr auto kBurstPause = std::chrono::microseconds(250);

// Timers get their turn after so many messages at the latest.
constexpr int kMessagesInARow = 100;

sigset_t EndSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

int Checked(int fd, const char* what) {
  if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
  return fd;
}

/// Callbacks that are not message handlers answer for themselves; one that fails must not end the node.
void RunGuarded(const std::function<void()>& callback) {
  try {
    callback();
  } catch (const std::exception& error) {
    spdlog::error("a callback failed: {}", error.what());
  }
}

}  // namespace

void BlockEndSignals() {
  const sigset_t signals = EndSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

LiveExecutor::LiveExecutor(std::shared_ptr<lcm::LCM> transport)
    : transport_(std::move(transport)), clock_(TheHostClock()) {
  assert(transport_ && transport_->good());
  BlockEndSignals();
  const sigset_t signals = EndSignals();
  wake_fd_ = Checked(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd");
  signal_fd_ = Checked(signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC), "signalfd");
}

LiveExecutor::~LiveExecutor() {
  close(wake_fd_);
  close(signal_fd_);
}

void LiveExecutor::Every(Utime period, std::function<void()> callback, Utime phase) {
  timers_.Every(Now(), period, std::move(callback), phase);
}

void LiveExecutor::At(Utime when, std::function<void()> callback) { timers_.At(when, std::move(callback)); }

void LiveExecutor::PauseBurst() { std::this_thread::sleep_for(kBurstPause); }

void LiveExecutor::Post(std::function<void()> callback) {
  {
    const std::lock_guard lock(posted_mutex_);
    posted_.push_back(std::move(callback));
  }
  eventfd_write(wake_fd_, 1);
}

void LiveExecutor::Watch(int fd, std::function<void()> callback) { watched_[fd] = std::move(callback); }

void LiveExecutor::Unwatch(int fd) { watched_.erase(fd); }

void LiveExecutor::Stop() {
  stop_ = true;
  eventfd_write(wake_fd_, 1);
}

void LiveExecutor::RunPosted() {
  eventfd_t count = 0;
  eventfd_read(wake_fd_, &count);
  std::vector<std::function<void()>> posted;
  {
    const std::lock_guard lock(posted_mutex_);
    posted.swap(posted_);
  }
  for (const auto& callback : posted) RunGuarded(callback);
}

void LiveExecutor::HandleMessages() {
  for (int i = 0; i < kMessagesInARow; ++i) {
    const int handled = transport_->handleTimeout(0);
    if (handled < 0) throw std::runtime_error("the LCM transport has failed");
    if (handled == 0) return;
  }
}

void LiveExecutor::Run() {
  const int lcm_fd = transport_->getFileno();
  while (!stop_) {
    std::vector<pollfd> fds{{lcm_fd, POLLIN, 0}, {wake_fd_, POLLIN, 0}, {signal_fd_, POLLIN, 0}};
    for (const auto& [fd, callback] : watched_) fds.push_back({fd, POLLIN, 0});

    const auto next = timers_.Next();
    const Utime wait = next ? std::clamp<Utime>(*next - Now(), 0, kSecond) : kSecond;
    const timespec timeout{wait / kSecond, wait % kSecond * 1000};
    if (ppoll(fds.data(), fds.size(), &timeout, nullptr) < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    if (fds[2].revents != 0) {
      signalfd_siginfo taken;
      if (read(signal_fd_, &taken, sizeof taken) == sizeof taken) return;
    }
    if (fds[0].revents != 0) HandleMessages();
    if (fds[1].revents != 0) RunPosted();
    for (std::size_t i = 3; i < fds.size() && !stop_; ++i) {
      const auto found = fds[i].revents != 0 ? watched_.find(fds[i].fd) : watched_.end();
      if (found == watched_.end()) continue;
      const auto callback = found->second;  // a copy, for it may unwatch itself
      RunGuarded(callback);
    }
    const Utime now = Now();
    while (!stop_ && timers_.Next().value_or(now + 1) <= now) {
      RunGuarded([&] { timers_.RunOne(now); });
    }
  }
  stop_ = false;  // only now, for a Stop() that came before Run() counts
}

}  // namespace skein::bus

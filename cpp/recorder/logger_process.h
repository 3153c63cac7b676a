#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>

#include "bus/live_executor.h"

namespace skein::recorder {

/// A running lcm-logger. It ends with this object and, by the kernel's doing, with this process.
class LoggerProcess {
 public:
  /// How it ended, for people: "was killed (signal 9)", "ended (exit code 1): No space left on device".
  using OnEnd = std::function<void(const std::string& how)>;

  /// @param file what it is to open; it appends. @param on_end is called on the executor's thread, and may
  /// destroy this. Throws std::system_error when no process can be made.
  LoggerProcess(bus::LiveExecutor& executor, const std::string& lcm_url, const std::filesystem::path& file,
                OnEnd on_end);
  ~LoggerProcess();
  LoggerProcess(const LoggerProcess&) = delete;
  LoggerProcess& operator=(const LoggerProcess&) = delete;

  /// Has it close its file and open `file` again, with the next message that comes. Nothing gets lost
  /// between: it queues what it hears.
  void OpenAgain();
  /// Asks it to write what it has heard and end.
  void End();
  void Kill();

 private:
  void HearEnd();
  void HearOutput();

  bus::LiveExecutor& executor_;
  OnEnd on_end_;
  pid_t pid_ = -1;
  int process_fd_ = -1;
  int output_fd_ = -1;
  std::string last_line_;  ///< of what it complained about
};

}  // namespace skein::recorder

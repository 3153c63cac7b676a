#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::testing {

using Seconds = std::chrono::duration<double>;

/// How a process ended: its exit code, or minus the signal that killed it.
using ExitCode = int;

/// A child process in a group of its own, its standard output and error read together. Whatever is left of
/// the group is killed when this is destroyed.
class Process {
 public:
  /// @param command the program, sought on PATH, and its arguments. @param environment added to this
  /// process's own.
  explicit Process(const std::vector<std::string>& command,
                   const std::map<std::string, std::string>& environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void Signal(int number) const;

  /// Waits for its end, at most `timeout`. None when it still runs then.
  std::optional<ExitCode> WaitForEnd(Seconds timeout);

  /// Waits until what it has printed contains `text`, at most `timeout`. False also when it ends without.
  bool WaitForOutput(const std::string& text, Seconds timeout);

  /// All it has printed up to now.
  const std::string& output() const { return output_; }

 private:
  /// Reads output until `done` says so, or the process has ended and all is read, or time is up.
  void ReadUntil(const std::function<bool()>& done, Seconds timeout);
  void Reap();

  pid_t pid_ = -1;
  int process_fd_ = -1;  // readable once the process has ended
  int output_fd_ = -1;
  std::string output_;
  std::optional<ExitCode> exit_code_;
};

/// The exit code and output of a command that has to end within `timeout`; a test failure when it doesn't.
struct Finished {
  std::optional<ExitCode> exit_code;
  std::string output;
};
Finished RunToEnd(const std::vector<std::string>& command, Seconds timeout = Seconds(30));

/// The processes of this host whose command line contains `text`.
std::vector<pid_t> ProcessesWith(const std::string& text);

/// The running process of a program whose command line contains `text`; 0 when there is none.
pid_t FindProcess(const std::string& program, const std::string& text);

/// Waits until all of these have ended, whoever started them. False when one still runs after `timeout`.
bool WaitUntilGone(const std::vector<pid_t>& processes, Seconds timeout);

/// A TCP (or UDP) port that nobody uses at the moment.
int FreeTcpPort();
int FreeUdpPort();

/// The bus of one test: real multicast on this host, on a port of its own.
std::string FreshLcmUrl();

/// The path of one of our programs.
std::string Program(const std::string& name);

/// A new empty folder, below the system's for temporary files.
std::string FreshFolder(const std::string& name);

}  // namespace skein::testing

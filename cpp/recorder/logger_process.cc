#include "recorder/logger_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "bus/transport.h"

namespace skein::recorder {
namespace {

constexpr int kEndTimeout_ms = 3000;
constexpr int kNotFound = 127;

[[noreturn]] void Throw(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// What becomes lcm-logger. Only what is safe in a copy of a process with threads.
[[noreturn]] void Become(char* const* arguments, int output_fd, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kNotFound);  // it has died meanwhile
  // It says something before it writes what it has heard and ends, and then nobody may be there any more to
  // hear that.
  signal(SIGPIPE, SIG_IGN);
  // Ctrl-C at a terminal is for flight-recorder, which ends its logger last.
  setsid();
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(output_fd, STDOUT_FILENO);
  dup2(output_fd, STDERR_FILENO);
  execvp(arguments[0], arguments);
  _exit(kNotFound);
}

std::string HowItEnded(int status, const std::string& last_line) {
  if (WIFSIGNALED(status)) return fmt::format("was killed (signal {})", WTERMSIG(status));
  if (WEXITSTATUS(status) == kNotFound) return "is not installed (Debian: apt-get install liblcm-bin)";
  std::string how = fmt::format("ended (exit code {})", WEXITSTATUS(status));
  return last_line.empty() ? how : how + ": " + last_line;
}

}  // namespace

LoggerProcess::LoggerProcess(bus::LiveExecutor& executor, const std::string& lcm_url,
                             const std::filesystem::path& file, OnEnd on_end)
    : executor_(executor), on_end_(std::move(on_end)) {
  // Its short -l is broken in 1.3.1.
  std::vector<std::string> words{"lcm-logger", "--quiet", "--append",
                                 "--lcm-url=" + bus::WithReceiveBuffer(lcm_url), file.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  std::array<int, 2> output{};
  if (pipe2(output.data(), O_CLOEXEC | O_NONBLOCK) != 0) Throw("pipe");
  const pid_t self = getpid();
  pid_ = fork();
  if (pid_ == 0) Become(arguments.data(), output[1], self);
  const int reason = errno;
  close(output[1]);
  output_fd_ = output[0];
  if (pid_ < 0) {
    close(output_fd_);
    errno = reason;
    Throw("lcm-logger cannot be started");
  }
  process_fd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  executor_.Watch(process_fd_, [this] { HearEnd(); });
  executor_.Watch(output_fd_, [this] { HearOutput(); });
}

LoggerProcess::~LoggerProcess() {
  executor_.Unwatch(output_fd_);
  executor_.Unwatch(process_fd_);
  if (pid_ > 0) {
    End();
    pollfd ended{process_fd_, POLLIN, 0};
    if (poll(&ended, 1, kEndTimeout_ms) == 0) {
      spdlog::warn("lcm-logger does not end; killed");
      Kill();
    }
    waitpid(pid_, nullptr, 0);
  }
  close(process_fd_);
  close(output_fd_);
}

void LoggerProcess::OpenAgain() { kill(pid_, SIGHUP); }
void LoggerProcess::End() { kill(pid_, SIGTERM); }
void LoggerProcess::Kill() { kill(pid_, SIGKILL); }

void LoggerProcess::HearOutput() {
  std::array<char, 1024> bytes{};
  const ssize_t count = read(output_fd_, bytes.data(), bytes.size());
  if (count <= 0) {
    if (count == 0) executor_.Unwatch(output_fd_);
    return;
  }
  std::string text(bytes.data(), static_cast<std::size_t>(count));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  spdlog::info("lcm-logger: {}", text);
  last_line_ = text.substr(text.find_last_of('\n') + 1);
}

void LoggerProcess::HearEnd() {
  int status = 0;
  // Not ended: the call was for an earlier process that had the same file descriptor.
  if (waitpid(pid_, &status, WNOHANG) != pid_) return;
  pid_ = -1;
  HearOutput();
  executor_.Unwatch(process_fd_);
  // A copy: what it does may end this object.
  const OnEnd on_end = on_end_;
  on_end(HowItEnded(status, last_line_));
}

}  // namespace skein::recorder

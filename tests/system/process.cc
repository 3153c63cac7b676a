#include "system/process.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace skein::testing {
namespace {

using Clock = std::chrono::steady_clock;
using Deadline = std::chrono::time_point<Clock, Seconds>;

[[noreturn]] void ThrowErrno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

int OpenProcess(pid_t process) { return static_cast<int>(syscall(SYS_pidfd_open, process, 0)); }

int MillisecondsUntil(Deadline deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::max<decltype(left)>(left, 0));
}

int FreePort(int type) {
  const int socket_fd = socket(AF_INET, type, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(socket_fd, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      getsockname(socket_fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    ThrowErrno("no free port");
  }
  close(socket_fd);
  return ntohs(address.sin_port);
}

[[noreturn]] void RunChild(const std::vector<std::string>& command,
                           const std::map<std::string, std::string>& environment, int output_fd) {
  setpgid(0, 0);
  sigset_t none;  // a live executor in this test blocks signals, and a child would inherit that
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(output_fd, STDOUT_FILENO);
  dup2(output_fd, STDERR_FILENO);
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments.front(), arguments.data());
  std::perror(arguments.front());
  _exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& command,
                 const std::map<std::string, std::string>& environment) {
  std::array<int, 2> pipe_fds{};
  if (pipe2(pipe_fds.data(), O_CLOEXEC) != 0) ThrowErrno("pipe");
  pid_ = fork();
  if (pid_ < 0) ThrowErrno("fork");
  if (pid_ == 0) RunChild(command, environment, pipe_fds[1]);
  setpgid(pid_, pid_);  // in both, so that it holds for whoever comes first
  close(pipe_fds[1]);
  output_fd_ = pipe_fds[0];
  fcntl(output_fd_, F_SETFL, O_NONBLOCK);
  process_fd_ = OpenProcess(pid_);
  if (process_fd_ < 0) ThrowErrno("pidfd_open");
}

Process::~Process() {
  kill(-pid_, SIGKILL);
  if (!exit_code_) waitpid(pid_, nullptr, 0);
  close(process_fd_);
  close(output_fd_);
}

void Process::Signal(int number) const { kill(pid_, number); }

void Process::Reap() {
  int status = 0;
  if (exit_code_ || waitpid(pid_, &status, WNOHANG) != pid_) return;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void Process::ReadUntil(const std::function<bool()>& done, Seconds timeout) {
  const Deadline deadline = Clock::now() + timeout;
  while (true) {
    std::array<char, 4096> buffer{};
    ssize_t size = 0;
    while ((size = read(output_fd_, buffer.data(), buffer.size())) > 0) {
      output_.append(buffer.data(), static_cast<std::size_t>(size));
    }
    const bool output_is_over = size == 0;  // poll would return at once for ever
    if (done() || exit_code_) return;
    const int left_ms = MillisecondsUntil(deadline);
    if (left_ms == 0) return;
    std::array<pollfd, 2> waiting{pollfd{output_is_over ? -1 : output_fd_, POLLIN, 0},
                                  pollfd{process_fd_, POLLIN, 0}};
    poll(waiting.data(), waiting.size(), left_ms);
    if ((waiting[1].revents & POLLIN) != 0) Reap();
  }
}

std::optional<ExitCode> Process::WaitForEnd(Seconds timeout) {
  Reap();  // it may have ended already, and there may be no time to wait
  ReadUntil([] { return false; }, timeout);
  return exit_code_;
}

bool Process::WaitForOutput(const std::string& text, Seconds timeout) {
  const auto printed = [&] { return output_.find(text) != std::string::npos; };
  ReadUntil(printed, timeout);
  return printed();
}

Finished RunToEnd(const std::vector<std::string>& command, Seconds timeout) {
  Process process(command);
  const std::optional<ExitCode> exit_code = process.WaitForEnd(timeout);
  EXPECT_TRUE(exit_code) << command.front() << " still runs after " << timeout.count() << " s";
  return {exit_code, process.output()};
}

int FreeTcpPort() { return FreePort(SOCK_STREAM); }
int FreeUdpPort() { return FreePort(SOCK_DGRAM); }

std::string FreshLcmUrl() { return "udpm://239.255.76.67:" + std::to_string(FreeUdpPort()) + "?ttl=0"; }

std::vector<pid_t> ProcessesWith(const std::string& text) {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(entry.path() / "cmdline");  // empty for one that has ended
    const std::string command{std::istreambuf_iterator<char>(file), {}};
    if (command.find(text) != std::string::npos) found.push_back(std::stoi(name));
  }
  return found;
}

pid_t FindProcess(const std::string& program, const std::string& text) {
  for (const pid_t process : ProcessesWith(text)) {
    std::error_code gone;
    if (std::filesystem::read_symlink("/proc/" + std::to_string(process) + "/exe", gone).filename() ==
        program) {
      return process;
    }
  }
  return 0;
}

bool WaitUntilGone(const std::vector<pid_t>& processes, Seconds timeout) {
  const Deadline deadline = Clock::now() + timeout;
  for (const pid_t process : processes) {
    const int process_fd = OpenProcess(process);
    if (process_fd < 0) continue;
    pollfd ended{process_fd, POLLIN, 0};
    const bool gone = poll(&ended, 1, MillisecondsUntil(deadline)) == 1;
    close(process_fd);
    if (!gone) return false;
  }
  return true;
}

std::string Program(const std::string& name) { return std::string(SKEIN_BIN_DIR) + "/" + name; }

std::string FreshFolder(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
  if (mkdtemp(pattern.data()) == nullptr) ThrowErrno(pattern);
  return pattern;
}

}  // namespace skein::testing

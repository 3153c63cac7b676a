#include "bus/host_clock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace skein::bus {
namespace {

namespace fs = std::filesystem;

template <typename Clock>
Utime Microseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

Utime WallOffset() {
  return Microseconds<std::chrono::system_clock>() - Microseconds<std::chrono::steady_clock>();
}

/// The steady clock begins anew with each boot.
std::string BootId() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string id;
  file >> id;
  return id;
}

/// None when it is not that of this boot.
std::optional<Utime> Read(int fd) {
  std::array<char, 128> bytes{};
  const ssize_t count = pread(fd, bytes.data(), bytes.size(), 0);
  std::istringstream text(std::string(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0));
  std::string boot;
  Utime offset = 0;
  if (!(text >> boot >> offset) || boot != BootId()) return std::nullopt;
  return offset;
}

void Write(int fd, Utime offset) {
  const std::string text = BootId() + " " + std::to_string(offset) + "\n";
  if (ftruncate(fd, 0) != 0 || pwrite(fd, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    (void)!ftruncate(fd, 0);  // a full disk: everybody has a clock of his own, as good as the wall clock
  }
}

/// Somebody else's file would let him set our time.
int OpenOwn(const fs::path& file) {
  const int fd = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  struct stat status {};
  if (fd >= 0 && (fstat(fd, &status) != 0 || status.st_uid != geteuid() || !S_ISREG(status.st_mode))) {
    close(fd);
    return -1;
  }
  return fd;
}

}  // namespace

HostClock::HostClock(const fs::path& file) : offset_(WallOffset()) {
  if (file.empty()) return;
  fd_ = OpenOwn(file);
  if (fd_ < 0) return;
  // Nobody else is there: his lock would be in the way.
  if (flock(fd_, LOCK_EX | LOCK_NB) == 0) Write(fd_, offset_);
  // One lock is given back before the other one is had, so somebody may have written in between.
  flock(fd_, LOCK_SH);
  offset_ = Read(fd_).value_or(offset_);
}

HostClock::~HostClock() {
  if (fd_ >= 0) close(fd_);
}

Utime HostClock::Now() const { return offset_ + Microseconds<std::chrono::steady_clock>(); }
Utime HostClock::WallAhead() const { return WallOffset() - offset_; }

fs::path HostClock::File() {
  if (const char* file = std::getenv("SKEIN_CLOCK_FILE")) return file;
  std::error_code none;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const fs::path folder = runtime != nullptr && fs::is_directory(runtime, none)
                              ? fs::path(runtime)
                              : fs::temp_directory_path(none);
  return none ? fs::path() : folder / ("skein-clock-" + std::to_string(geteuid()));
}

const HostClock& TheHostClock() {
  static const HostClock clock(HostClock::File());
  return clock;
}

}  // namespace skein::bus

#pragma once

#include <filesystem>

#include "bus/executor.h"

namespace skein::bus {

/// The time of all Skein programs on this host: the wall clock as it was when the first of those that run now
/// was started, plus the steady clock since. A wall clock that is set moves nothing, also not for a program
/// that is started afterwards: one that is brought back after a fault goes on in the time of the others.
///
/// It is shared by a file, which everybody who goes by it holds locked; with nobody there it is set anew.
class HostClock {
 public:
  /// @param file "": a clock of one's own. One that cannot be opened is as good as none.
  explicit HostClock(const std::filesystem::path& file);
  ~HostClock();
  HostClock(const HostClock&) = delete;
  HostClock& operator=(const HostClock&) = delete;

  Utime Now() const;
  /// How far the wall clock is ahead of Now(): what it was set by.
  Utime WallAhead() const;

  /// $SKEIN_CLOCK_FILE, else one for this user in $XDG_RUNTIME_DIR or, without that, in the folder for
  /// temporary files.
  static std::filesystem::path File();

 private:
  Utime offset_;  ///< of Now() from the steady clock
  int fd_ = -1;   ///< locked for as long as this lives
};

/// That of this process.
const HostClock& TheHostClock();

}  // namespace skein::bus

#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>

#include "bus/executor.h"

namespace skein::recording {

/// Writes a log that lcm-logplayer and LogFile read, to any stream. Events are numbered from 0.
class LogOutput {
 public:
  /// @param stream outlives this; whether it is good is the caller's to see.
  explicit LogOutput(std::ostream& stream) : stream_(stream) {}

  void Write(bus::Utime utime, std::string_view channel, std::span<const std::byte> data);

 private:
  std::ostream& stream_;
  std::int64_t number_ = 0;
};

}  // namespace skein::recording

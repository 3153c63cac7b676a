#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace skein::recording {

/// An event as LCM writes it.
inline std::string EventBytes(std::int64_t number, std::int64_t utime, std::string_view channel,
                              std::string_view data) {
  std::string bytes = "\xED\xA1\xDA\x01";
  const auto append = [&](std::uint64_t value, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  };
  append(static_cast<std::uint64_t>(number), 8);
  append(static_cast<std::uint64_t>(utime), 8);
  append(channel.size(), 4);
  append(data.size(), 4);
  bytes += channel;
  bytes += data;
  return bytes;
}

/// A file that lives as long as this.
class LogBytes {
 public:
  explicit LogBytes(const std::string& bytes)
      : path_(std::filesystem::path(testing::TempDir()) /
              ("skein-" + std::to_string(getpid()) + "-" + std::to_string(++count) + ".lcm")) {
    Append(bytes);
  }
  ~LogBytes() { std::filesystem::remove_all(path_); }
  LogBytes(const LogBytes&) = delete;
  LogBytes& operator=(const LogBytes&) = delete;

  void Append(const std::string& bytes) {
    std::ofstream stream(path_, std::ios::binary | std::ios::app);
    stream << bytes;
    ASSERT_TRUE(stream.flush());
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  static inline int count = 0;
  std::filesystem::path path_;
};

}  // namespace skein::recording

#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace skein::experiment {

/// Better told before a flight than after it. Leaves an empty file where there was none; "" is no file.
/// Throws config::ConfigError.
void CheckWritable(const std::filesystem::path& file);

/// Throws std::runtime_error when it could not be written wholly.
void WriteFile(const std::filesystem::path& file, const std::string& text);

/// A line that tells how far it is, on a terminal alone, for what takes a while.
class Progress {
 public:
  /// @param unit of the total: "s", "runs"
  Progress(double total, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// At most five times a second.
  void Show(double done);

 private:
  using Clock = std::chrono::steady_clock;
  double total_;
  std::string unit_;
  bool shown_;
  bool wrote_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace skein::experiment

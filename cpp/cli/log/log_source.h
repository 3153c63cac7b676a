#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "recording/recording.h"

namespace skein::cli {

/// A bus has a few dozen; no more are told apart of a log that makes names up.
inline constexpr std::size_t kMostChannels = 10'000;

/// A recording as the `skein log` commands read it: with progress on a terminal, ended by Ctrl-C, and with a
/// word on standard error about what could not be read.
class LogSource {
 public:
  /// @param file of a recording; its other parts are found. Throws config::ConfigError with path and reason.
  explicit LogSource(const std::string& file);

  const recording::Recording& recording() const { return recording_; }
  std::vector<std::filesystem::path> parts() const;
  const std::string& file() const { return file_; }
  /// Without folder and ".lcm".
  std::string name() const;

  /// One event and when it was logged: seconds since the first event of the recording, which never go back
  /// (recording/log_clock.h).
  using Use = std::function<bool(const recording::LogEvent& event, double t_s)>;

  /// Goes through the recording until `use` returns false. Throws Interrupted.
  void ForEach(const Use& use);

  /// Remembers what a reader of recording() has found damaged; ForEach does it by itself.
  void Note(const recording::RecordingReader& reader);
  /// What could not be read, as far as it was read.
  const std::vector<recording::PartDamage>& damage() const { return damage_; }
  std::uint64_t damaged_bytes() const { return damaged_bytes_; }
  /// Says so on standard error.
  void TellProblems() const;

 private:
  std::string file_;
  recording::Recording recording_;
  std::vector<recording::PartDamage> damage_;
  std::uint64_t damaged_bytes_ = 0;
};

/// How far a long piece of work has come, on standard error: only when that is a terminal and standard
/// output, which would be mixed up with it, is not, and only when it takes a moment.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// @param share 0 .. 1.
  void Show(double share);

 private:
  std::string what_;
  bool is_shown_;
  bool wrote_ = false;
  std::int64_t next_ms_;
};

/// From now on Ctrl-C and SIGTERM end a command by ThrowIfInterrupted() instead of the program, so that half
/// a file is taken away.
void CatchInterrupts();
/// Throws Interrupted.
void ThrowIfInterrupted();

}  // namespace skein::cli

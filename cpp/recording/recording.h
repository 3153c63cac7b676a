#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recording/log_file.h"

namespace skein::recording {

/// The files of a recording in their order, those that are there: NAME.lcm, NAME.lcm.01, NAME.lcm.02, ... as
/// flight-recorder splits it; without NAME.lcm itself, NAME.lcm.00 is the first, as `lcm-logger -i
/// --split-mb` has it. A file of any other name, or one part named alone, is all of its recording.
std::vector<std::filesystem::path> PartsOf(const std::filesystem::path& file);

/// Files of one folder as recordings: by the name of each ("flight.lcm") its parts in their order.
std::map<std::string, std::vector<std::filesystem::path>> GroupParts(
    const std::vector<std::filesystem::path>& files);

/// A flight as it was recorded, in one file or several.
class Recording {
 public:
  /// Opens all parts that PartsOf() finds. Throws std::runtime_error with path and reason when none of them
  /// is a log; a part that is none beside others that are is a problem only.
  explicit Recording(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::unique_ptr<LogFile>>& parts() const { return parts_; }
  /// Parts that are missing or cannot be read, each in words for people.
  const std::vector<std::string>& problems() const { return problems_; }
  std::uint64_t bytes() const;  ///< of all parts

 private:
  std::filesystem::path file_;
  std::vector<std::unique_ptr<LogFile>> parts_;
  std::vector<std::string> problems_;
};

/// A stretch of one part of a recording that holds no event that could be read.
struct PartDamage {
  std::filesystem::path file;
  Damage damage;
};

/// Walks through the events of a recording from part to part.
class RecordingReader {
 public:
  /// @param recording outlives the reader.
  explicit RecordingReader(const Recording& recording);

  /// The next event, none at the end. Its views are good until the next call.
  std::optional<LogEvent> Next();

  std::uint64_t bytes_read() const;  ///< up to now, of Recording::bytes()
  std::vector<PartDamage> damage() const;
  std::uint64_t damaged_bytes() const;

 private:
  const Recording& recording_;
  std::vector<std::unique_ptr<LogReader>> readers_;  ///< of the parts up to the present one
  std::uint64_t bytes_before_ = 0;
};

}  // namespace skein::recording

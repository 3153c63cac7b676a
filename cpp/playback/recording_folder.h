#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bus/executor.h"

namespace skein::playback {

/// A recording as it lies in a folder, not opened.
struct RecordingFiles {
  std::string name;                          ///< of the first part, also when that one is gone
  std::vector<std::filesystem::path> parts;  ///< in order, one at least
  std::uint64_t bytes = 0;
  bus::Utime changed = 0;      ///< when one of them last did, by the file system's clock
  bool recording_now = false;  ///< it is still being written

  /// Whether nothing has changed.
  bool operator==(const RecordingFiles&) const = default;
};

/// All recordings in a folder: logs and the parts of logs, by name. Never what a symbolic link leads to, nor
/// hidden files. A folder that cannot be read has none.
std::vector<RecordingFiles> FindRecordings(const std::filesystem::path& folder);

/// The one of that name; `trusted`: whatever it begins with, as the operator has named it.
std::optional<RecordingFiles> FindRecording(const std::filesystem::path& folder, const std::string& name,
                                            bool trusted);

/// Removes a recording, its index and its card. Returns why it could not be, "" when all is gone.
std::string RemoveRecording(const std::filesystem::path& folder, const RecordingFiles& files);

}  // namespace skein::playback

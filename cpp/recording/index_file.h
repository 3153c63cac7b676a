#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "recording/log_index.h"

namespace skein::recording {

inline constexpr const char* kIndexExtension = ".skein-index";

/// "flight.lcm.skein-index" beside "flight.lcm".
std::filesystem::path IndexFileOf(const std::filesystem::path& log);

/// The index that was saved beside a log; none when there is none, it is damaged, of another version, or the
/// log has changed since.
std::optional<LogIndex> LoadIndex(const std::filesystem::path& log);

/// Saves it for the next time; the file appears whole or not at all. Returns why it could not be, "" when it
/// was: it is only a cache, so that is no error.
std::string SaveIndex(const std::filesystem::path& log, const LogIndex& index);

}  // namespace skein::recording

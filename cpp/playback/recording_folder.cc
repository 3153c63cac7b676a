#include "playback/recording_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>

#include "recording/card.h"
#include "recording/index_file.h"
#include "recording/recording.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;

// A log that has no card (flight-recorder's note beside it) and changed so lately may be in the making:
// lcm-logger writes at least once a second, as every node sends a HEARTBEAT.
constexpr bus::Utime kJustChanged = 5 * bus::kSecond;

bool IsLog(const fs::path& file) {
  constexpr std::array<char, 4> kMagic = {'\xED', '\xA1', '\xDA', '\x01'};
  std::array<char, 4> begin{};
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), begin.size()) && begin == kMagic;
}

bus::Utime WallClock() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

bus::Utime Changed(const struct stat& status) {
  return status.st_mtim.tv_sec * bus::kSecond + status.st_mtim.tv_nsec / 1000;
}

bool JustChanged(bus::Utime changed) {
  const bus::Utime age = WallClock() - changed;
  return age >= 0 && age < kJustChanged;
}

/// As the file system says now; none when all of it is gone.
std::optional<RecordingFiles> Look(const fs::path& folder, const std::string& name,
                                   const std::vector<fs::path>& parts) {
  RecordingFiles files;
  files.name = name;
  for (const fs::path& part : parts) {
    struct stat status {};
    if (lstat(part.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    files.parts.push_back(part);
    files.bytes += static_cast<std::uint64_t>(status.st_size);
    files.changed = std::max(files.changed, Changed(status));
  }
  if (files.parts.empty()) return std::nullopt;
  const fs::path card = recording::CardOf(folder / name);
  if (recording::IsCard(card)) {
    files.recording_now = recording::IsHeld(card);
  } else {
    files.recording_now = JustChanged(files.changed);
  }
  return files;
}

/// What may be a recording or a part of one, by its name alone.
std::vector<fs::path> Candidates(const fs::path& folder) {
  std::vector<fs::path> candidates;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& file = entry->path();
    const bool is_beside = file.extension() == ".json" || file.extension() == recording::kIndexExtension;
    std::error_code unknown;
    const bool is_file = !entry->is_symlink(unknown) && entry->is_regular_file(unknown);
    if (file.filename().string().starts_with('.') || is_beside || !is_file) continue;
    candidates.push_back(file);
  }
  return candidates;
}

bool IsRecording(const std::string& name, const std::vector<fs::path>& parts) {
  return name.ends_with(".lcm") || (!parts.empty() && IsLog(parts.front()));
}

}  // namespace

std::vector<RecordingFiles> FindRecordings(const fs::path& folder) {
  std::vector<RecordingFiles> found;
  for (const auto& [name, parts] : recording::GroupParts(Candidates(folder))) {
    if (!IsRecording(name, parts)) continue;
    if (auto files = Look(folder, name, parts)) found.push_back(std::move(*files));
  }
  return found;
}

std::optional<RecordingFiles> FindRecording(const fs::path& folder, const std::string& name, bool trusted) {
  if (trusted) return Look(folder, name, recording::PartsOf(folder / name));
  // By looking at what is there: no name leads out of the folder, and no part is a recording by itself.
  const auto recordings = recording::GroupParts(Candidates(folder));
  const auto found = recordings.find(name);
  if (found == recordings.end() || !IsRecording(name, found->second)) return std::nullopt;
  return Look(folder, name, found->second);
}

std::string RemoveRecording(const fs::path& folder, const RecordingFiles& files) {
  std::string problem;
  const auto remove = [&](const fs::path& file) {
    std::error_code error;
    fs::remove(file, error);
    if (error && problem.empty()) problem = file.filename().string() + ": " + error.message();
  };
  for (const fs::path& part : files.parts) {
    remove(part);
    remove(recording::IndexFileOf(part));
  }
  const fs::path card = recording::CardOf(folder / files.name);
  // What else may have that name is not ours.
  if (problem.empty() && recording::IsCard(card)) remove(card);
  return problem;
}

}  // namespace skein::playback

#include "playback/recording_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <set>
#include <string_view>

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

/// "flight.lcm" of "flight.lcm.07"; any other name as it is.
std::string NameOf(const std::string& file_name) {
  const std::size_t dot = file_name.rfind('.');
  const bool numbered = dot != std::string::npos && dot + 1 < file_name.size() &&
                        std::all_of(file_name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, file_name.end(),
                                    [](unsigned char c) { return c >= '0' && c <= '9'; });
  return numbered && file_name.substr(0, dot).ends_with(".lcm") ? file_name.substr(0, dot) : file_name;
}

fs::path CardOf(const fs::path& folder, const std::string& name) { return folder / (name + ".json"); }

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

/// Whether a flight-recorder holds the card; none when there is no card.
std::optional<bool> CardIsHeld(const fs::path& card) {
  const int descriptor = open(card.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return std::nullopt;
  // One that is just being made is not even tried, lest its maker finds it taken by us.
  struct stat status {};
  const bool held = (fstat(descriptor, &status) == 0 && JustChanged(Changed(status))) ||
                    flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  close(descriptor);
  return held;
}

std::optional<RecordingFiles> Look(const fs::path& folder, const std::string& name) {
  RecordingFiles files;
  files.name = name;
  for (const fs::path& part : recording::PartsOf(folder / name)) {
    struct stat status {};
    if (lstat(part.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    files.parts.push_back(part);
    files.bytes += static_cast<std::uint64_t>(status.st_size);
    files.changed = std::max(files.changed, Changed(status));
  }
  if (files.parts.empty()) return std::nullopt;
  const auto held = CardIsHeld(CardOf(folder, name));
  files.recording_now = held ? *held : JustChanged(files.changed);
  return files;
}

}  // namespace

std::vector<RecordingFiles> FindRecordings(const fs::path& folder, const std::string& only) {
  std::set<std::string> names;
  if (!only.empty()) names.insert(only);
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; only.empty() && !error && entry != end;
       entry.increment(error)) {
    const std::string file_name = entry->path().filename().string();
    const std::string name = NameOf(file_name);
    std::error_code unknown;
    if (file_name.starts_with('.')) continue;
    if (!fs::is_regular_file(entry->symlink_status(unknown))) continue;
    if (name.ends_with(".lcm") || IsLog(entry->path())) names.insert(name);
  }
  std::vector<RecordingFiles> found;
  for (const std::string& name : names) {
    if (auto files = Look(folder, name)) found.push_back(std::move(*files));
  }
  return found;
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
  if (problem.empty()) remove(CardOf(folder, files.name));
  return problem;
}

}  // namespace skein::playback

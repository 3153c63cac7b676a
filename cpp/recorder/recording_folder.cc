#include "recorder/recording_folder.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "recorder/recording.h"
#include "recording/card.h"
#include "recording/index_file.h"

namespace skein::recorder {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostRoomToBegin = 64'000'000;

/// A part that lies in the folder and is what its card says.
struct Found {
  fs::path file;
  fs::path card;
  bus::Utime start_utime = 0;
  int part = 0;
  std::int64_t bytes = 0;
  bool running = false;
};

std::optional<struct statvfs> DiskOf(fs::path folder) {
  std::error_code ignored;
  folder = fs::absolute(folder, ignored);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  struct statvfs disk {};
  if (statvfs(folder.c_str(), &disk) != 0) return std::nullopt;
  return disk;
}

bool EndsWith(std::string_view text, std::string_view end) {
  return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

/// The parts of a card; nothing when it is no card of ours.
std::vector<Found> PartsOf(const fs::path& card) {
  std::vector<Found> parts;
  if (!recording::IsCard(card)) return parts;
  try {
    std::ifstream stream(card);
    const auto json = nlohmann::json::parse(stream);
    const std::string name = card.stem().string();
    const bool running = recording::IsHeld(card);
    for (const auto& item : json.at("parts")) {
      const auto file = item.at("file").get<std::string>();
      Found found{card.parent_path() / file, card, json.at("start_utime").get<bus::Utime>()};
      while (found.part < 100'000 && PartName(name, found.part) != file) ++found.part;
      if (found.part == 100'000) continue;  // a name that no part has, perhaps a path to elsewhere
      std::error_code gone;
      if (!fs::is_regular_file(fs::symlink_status(found.file, gone))) continue;
      found.bytes = static_cast<std::int64_t>(fs::file_size(found.file, gone));
      const auto begins = item.at("begins").get<std::string>();
      if (gone || begins.empty() || BeginOf(found.file) != begins) continue;
      found.running = running;
      parts.push_back(std::move(found));
    }
  } catch (const nlohmann::json::exception&) {
    return {};  // somebody else's, or damaged
  }
  return parts;
}

std::vector<Found> FindParts(const fs::path& folder) {
  std::vector<Found> parts;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    if (!EndsWith(entry.path().filename().string(), ".lcm.json") || !entry.is_regular_file(unreadable))
      continue;
    for (Found& part : PartsOf(entry.path())) parts.push_back(std::move(part));
  }
  std::ranges::sort(parts, [](const Found& a, const Found& b) {
    return std::tie(a.start_utime, a.card, a.part) < std::tie(b.start_utime, b.card, b.part);
  });
  return parts;
}

}  // namespace

std::optional<std::int64_t> FreeBytes(const fs::path& folder) {
  const auto disk = DiskOf(folder);
  if (!disk) return std::nullopt;
  return static_cast<std::int64_t>(disk->f_bavail * disk->f_frsize);
}

std::int64_t RoomToBegin(const fs::path& folder) {
  const auto disk = DiskOf(folder);
  if (!disk) return kMostRoomToBegin;
  return std::min(kMostRoomToBegin, static_cast<std::int64_t>(disk->f_blocks * disk->f_frsize / 20));
}

Removal MakeRoom(const fs::path& folder, const Room& room) {
  std::vector<Found> parts = FindParts(folder);
  std::int64_t bytes = 0;
  for (const Found& part : parts) bytes += part.bytes;
  const auto too_much = [&] { return bytes > room.quota_bytes; };
  Removal removal;
  // Looked at once: what is removed may take its time to be free, while others still read it.
  const std::int64_t free_bytes = FreeBytes(folder).value_or(room.keep_free_bytes);
  const auto too_little_free = [&] { return free_bytes + removal.bytes < room.keep_free_bytes; };
  for (auto part = parts.begin(); part != parts.end() && (too_much() || too_little_free()); ++part) {
    if (part->running) continue;
    std::error_code kept;
    if (!fs::remove(part->file, kept)) continue;
    fs::remove(recording::IndexFileOf(part->file), kept);
    const bool last =
        std::none_of(part + 1, parts.end(), [&](const Found& other) { return other.card == part->card; });
    if (last) fs::remove(part->card, kept);
    bytes -= part->bytes;
    removal.bytes += part->bytes;
    removal.files.push_back(part->file.filename().string());
  }
  removal.over_quota = too_much();
  removal.low = too_little_free();
  return removal;
}

}  // namespace skein::recorder

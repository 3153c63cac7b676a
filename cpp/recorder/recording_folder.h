#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::recorder {

/// How much recordings may take.
struct Room {
  std::int64_t quota_bytes = 10'000'000'000;     ///< of all recordings of the folder together
  std::int64_t keep_free_bytes = 1'000'000'000;  ///< on their disk
};

/// What this user may still write on the disk of a folder (or of where it would be) [B].
std::optional<std::int64_t> FreeBytes(const std::filesystem::path& folder);

/// So much beyond what is to be kept free must there be before recording begins again: else it would begin
/// and end all the time [B].
std::int64_t RoomToBegin(const std::filesystem::path& folder);

struct Removal {
  std::vector<std::string> files;  ///< names of what was removed, the oldest first
  std::int64_t bytes = 0;          ///< what they held
  bool over_quota = false;         ///< it is still too much, and nothing more can go
  bool low = false;                ///< less is free than is to be kept, and nothing more can go
};

/// Removes the oldest parts of recordings until they are within the quota and enough is free. Only what a
/// flight-recorder wrote: it must stand on a card (recording.h) and begin as the card says. Never a part of a
/// recording that is still written, by whomever: its card is locked. An index beside a part goes with it, and
/// a card with its last part.
Removal MakeRoom(const std::filesystem::path& folder, const Room& room);

}  // namespace skein::recorder

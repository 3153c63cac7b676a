#include "recording/card.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace skein::recording {

namespace fs = std::filesystem;

fs::path CardOf(const fs::path& recording) { return recording.string() + ".json"; }

bool IsCard(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object()) return false;
  const auto writer = json.find("written_by");
  return writer != json.end() && writer->is_string() &&
         writer->get_ref<const std::string&>().starts_with("flight-recorder ");
}

bool IsHeld(const fs::path& card) {
  const int descriptor = open(card.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return true;
  bool held = flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  // A new card, locked before, may have taken the name since this one was opened.
  struct stat opened {
  }, named{};
  held = held || fstat(descriptor, &opened) != 0 || lstat(card.c_str(), &named) != 0 ||
         opened.st_ino != named.st_ino || opened.st_dev != named.st_dev;
  close(descriptor);
  return held;
}

}  // namespace skein::recording

#pragma once

#include <filesystem>
#include <string>

namespace skein::testing {

/// What to LD_PRELOAD to set the clock of a program; "" when it is not installed.
inline std::string FakeTimeLibrary() {
  for (const auto& folder : std::filesystem::directory_iterator("/usr/lib")) {
    const std::filesystem::path file = folder.path() / "faketime/libfaketimeMT.so.1";
    if (std::filesystem::exists(file)) return file.string();
  }
  return "";
}

}  // namespace skein::testing

#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace skein::recorder::testing {

/// An empty folder that goes with it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "skein-recorder-test-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path;
};

inline void Append(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::app | std::ios::binary) << text;
}

/// What begins as no other one does.
inline std::string Content(int number, std::size_t size = 1000) {
  std::string text = "log " + std::to_string(number) + " ";
  text.resize(size, static_cast<char>('a' + number % 26));
  return text;
}

}  // namespace skein::recorder::testing

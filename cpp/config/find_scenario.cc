#include <cstdlib>

#include "config/scenario.h"

namespace skein::config {
namespace {

namespace fs = std::filesystem;

// Beside the sources, beside the executable in build/bin, and where `cmake --install` puts them.
std::vector<fs::path> Folders() {
  std::vector<fs::path> folders;
  if (const char* folder = std::getenv("SKEIN_SCENARIOS")) folders.emplace_back(folder);
  folders.emplace_back("scripts/scenarios");
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path folder = executable.parent_path();
    folders.push_back((folder / "../../scripts/scenarios").lexically_normal());
    folders.push_back((folder / "../share/skein/scenarios").lexically_normal());
  }
  return folders;
}

}  // namespace

fs::path FindScenario(const std::string& name) {
  if (name.empty()) throw ConfigError("no scenario was named");
  const fs::path given(name);
  std::error_code error;
  if (fs::exists(given, error) && !fs::is_directory(given, error)) return given;
  if (fs::is_directory(given, error) && given.has_parent_path())
    throw ConfigError(name + ": is a folder, not a scenario file");
  if (given.has_parent_path()) throw ConfigError(name + ": there is no such file");
  std::string searched;
  for (const fs::path& folder : Folders()) {
    for (const fs::path& candidate : {folder / given, folder / (name + ".json")}) {
      if (fs::is_regular_file(candidate, error)) return candidate;
    }
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw ConfigError(name + ": there is no such file, nor a scenario of that name in " + searched);
}

}  // namespace skein::config

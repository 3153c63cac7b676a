#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

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

// What is typed in a browser must never become a path.
bool IsBareName(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         std::ranges::all_of(
             name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.'; });
}

// The scenario files of a folder by their bare names, none when it cannot be read.
std::map<std::string, fs::path> FilesIn(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& file = entry->path();
    std::error_code ignored;
    if (file.extension() == ".json" && IsBareName(file.stem()) && fs::is_regular_file(file, ignored)) {
      files[file.stem()] = file;
    }
  }
  return files;
}

std::map<std::string, fs::path> FilesIn(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : folders) files.merge(FilesIn(folder));  // what is there already stays
  return files;
}

// What can be had by a bare name: beside `own` first.
std::map<std::string, fs::path> FilesBeside(const fs::path& own) {
  std::vector<fs::path> folders = Folders();
  if (!own.empty()) folders.insert(folders.begin(), fs::absolute(own).parent_path());
  return FilesIn(folders);
}

std::optional<Scenario> LoadIfNamed(const std::string& name, const fs::path& file) {
  try {
    Scenario scenario = LoadScenario(file);
    if (scenario.name == name) return scenario;
  } catch (const ConfigError&) {  // then it is not the one that flies
  }
  return std::nullopt;
}

ScenarioEntry Describe(const std::string& bare_name, const fs::path& file) {
  ScenarioEntry entry;
  entry.bare_name = bare_name;
  try {
    const Scenario scenario = LoadScenario(file);
    entry.name = scenario.name;
    entry.description = scenario.description;
    entry.vehicles = scenario.vehicles.size();
    entry.duration_s = scenario.duration_s;
  } catch (const ConfigError& error) {
    entry.problem = error.what();
  }
  return entry;
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

fs::path FindNamedScenario(const std::string& name, const fs::path& own) {
  if (!IsBareName(name)) {
    throw ConfigError("a scenario is named by letters, digits, '-', '_' and '.', without a folder");
  }
  const auto files = FilesBeside(own);
  const auto found = files.find(name);
  if (found != files.end()) return found->second;
  std::string known;
  for (const auto& [other, file] : files) known += (known.empty() ? "" : ", ") + other;
  throw ConfigError("there is no scenario " + name + "; there are: " + (known.empty() ? "none" : known));
}

std::optional<Scenario> ReadScenarioOfFleet(const std::string& name, const fs::path& own) {
  if (auto scenario = LoadIfNamed(name, own)) return scenario;
  for (const auto& [bare_name, file] : FilesBeside(own)) {
    if (auto scenario = LoadIfNamed(name, file)) return scenario;
  }
  return std::nullopt;
}

std::optional<std::string> BareNameOf(const std::string& name) {
  for (const auto& [bare_name, file] : FilesIn(Folders())) {
    std::ifstream stream(file);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!name.empty() && json.is_object() && json.contains("name") && json["name"] == name) return bare_name;
  }
  return std::nullopt;
}

std::vector<ScenarioEntry> ListScenarios() {
  std::vector<ScenarioEntry> entries;
  for (const auto& [bare_name, file] : FilesIn(Folders())) entries.push_back(Describe(bare_name, file));
  return entries;
}

}  // namespace skein::config

#include "recording/recording.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>
#include <system_error>

namespace skein::recording {
namespace {

namespace fs = std::filesystem;

/// 1 for "NAME.lcm.01", none for any other name.
std::optional<int> PartNumber(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || !name.substr(0, dot).ends_with(".lcm")) return std::nullopt;
  const std::string digits = name.substr(dot + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  // One digit alone is what `lcm-logger --rotate` gives, where 0 is the newest.
  if (!is_number || digits.size() < 2 || number < 0) return std::nullopt;
  return number;
}

}  // namespace

std::map<std::string, std::vector<fs::path>> GroupParts(const std::vector<fs::path>& files) {
  std::map<std::string, std::map<int, fs::path>> numbered;
  std::map<std::string, std::vector<fs::path>> recordings;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (const auto number = PartNumber(name)) {
      numbered[name.substr(0, name.rfind('.'))].emplace(*number, file);
    } else {
      recordings[name] = {file};
    }
  }
  for (auto& [name, parts] : numbered) {
    auto& recording = recordings[name];
    if (const auto zero = parts.find(0); zero != parts.end() && !recording.empty()) {
      recordings[zero->second.filename().string()] = {zero->second};
      parts.erase(zero);
    }
    for (const auto& [number, part] : parts) recording.push_back(part);
  }
  return recordings;
}

std::vector<fs::path> PartsOf(const fs::path& file) {
  std::vector<fs::path> siblings;
  const std::string name = file.filename().string();
  std::error_code error;
  if (fs::exists(file, error) || !name.ends_with(".lcm")) siblings.push_back(file);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; name.ends_with(".lcm") && !error && entry != end;
       entry.increment(error)) {
    const std::string other = entry->path().filename().string();
    if (other.starts_with(name + '.') && PartNumber(other)) siblings.push_back(file.parent_path() / other);
  }
  auto recordings = GroupParts(siblings);
  // A part that is named alone is asked for as it is; a file that is missing is told by whoever opens it.
  if (PartNumber(name) || siblings.empty()) return {file};
  return std::move(recordings[name]);
}

Recording::Recording(const fs::path& file) : file_(file) {
  std::string first_problem;
  int expected = 0;
  for (const fs::path& part : PartsOf(file)) {
    const int number = part == file ? 0 : PartNumber(part.filename().string()).value_or(0);
    if (number > expected) {
      problems_.push_back(number == expected + 1 ? "part " + std::to_string(expected) + " is missing"
                                                 : "parts " + std::to_string(expected) + " to " +
                                                       std::to_string(number - 1) + " are missing");
    }
    expected = number + 1;
    try {
      parts_.push_back(std::make_unique<LogFile>(part));
    } catch (const std::runtime_error& error) {
      problems_.emplace_back(error.what());
      if (first_problem.empty()) first_problem = error.what();
    }
  }
  if (parts_.empty()) throw std::runtime_error(first_problem);
}

std::uint64_t Recording::bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& part : parts_) bytes += part->bytes();
  return bytes;
}

RecordingReader::RecordingReader(const Recording& recording) : recording_(recording) {
  readers_.push_back(std::make_unique<LogReader>(*recording.parts().front()));
}

std::optional<LogEvent> RecordingReader::Next() {
  for (;;) {
    if (auto event = readers_.back()->Next()) return event;
    if (readers_.size() == recording_.parts().size()) return std::nullopt;
    bytes_before_ += recording_.parts()[readers_.size() - 1]->bytes();
    readers_.push_back(std::make_unique<LogReader>(*recording_.parts()[readers_.size()]));
  }
}

std::uint64_t RecordingReader::bytes_read() const { return bytes_before_ + readers_.back()->offset(); }

std::vector<PartDamage> RecordingReader::damage() const {
  std::vector<PartDamage> all;
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    for (const Damage& damage : readers_[i]->damage()) {
      all.push_back({recording_.parts()[i]->file(), damage});
    }
  }
  return all;
}

std::uint64_t RecordingReader::damaged_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& reader : readers_) bytes += reader->damaged_bytes();
  return bytes;
}

}  // namespace skein::recording

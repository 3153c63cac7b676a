#include "playback/open_recording.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <set>
#include <skein/event_t.hpp>
#include <stdexcept>
#include <utility>

#include "bus/channels.h"
#include "recording/index_file.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;
using recording::LogFile;
using recording::LogIndex;

std::uint64_t Size(const fs::path& file) {
  std::error_code missing;
  const std::uintmax_t size = fs::file_size(file, missing);
  return missing ? 0 : size;
}

/// None when it was given up.
std::optional<LogIndex> Index(const LogFile& log, const std::function<bool(double)>& go_on) {
  if (auto index = recording::LoadIndex(log.file()); index && index->bytes == log.bytes()) return index;
  auto index = recording::IndexLog(log, go_on);
  if (!index) return std::nullopt;
  const std::string problem = recording::SaveIndex(log.file(), *index);
  if (!problem.empty()) spdlog::debug("{}: the index is not kept: {}", log.file().string(), problem);
  return index;
}

/// What went wrong with a file, by its name alone: where this machine keeps it is nobody's business at a
/// page.
std::string Reason(const std::exception& error, const fs::path& file) {
  std::string text = error.what();
  const std::string path = file.string();
  if (text.starts_with(path)) text.replace(0, path.size(), file.filename().string());
  return text;
}

/// In its largest roster; where nobody has sent one, of whom there is telemetry.
int VehiclesOf(const RecordedFlight& flight) {
  int named = 0;
  std::set<std::string> heard;
  for (const auto& part : flight.parts()) {
    for (const auto& one : part.index->flights) named = std::max(named, int{one.vehicles});
    for (const std::string& stream : part.index->streams) {
      if (stream.starts_with(std::string(bus::channel::kFleetState) + "/")) heard.insert(stream);
    }
  }
  return named > 0 ? named : static_cast<int>(heard.size());
}

}  // namespace

std::shared_ptr<const RecordedFlight> OpenRecording(const std::vector<fs::path>& parts,
                                                    const std::function<bool(double)>& go_on) {
  double all_bytes = 1;
  for (const fs::path& file : parts) all_bytes += static_cast<double>(Size(file));
  double bytes_before = 0;
  std::vector<RecordedFlight::Part> opened;
  std::vector<std::string> problems;
  for (const fs::path& file : parts) {
    try {
      auto log = std::make_shared<const LogFile>(file);
      const auto bytes = static_cast<double>(log->bytes());
      auto index =
          Index(*log, [&](double progress) { return go_on((bytes_before + progress * bytes) / all_bytes); });
      if (!index) return nullptr;
      bytes_before += bytes;
      opened.push_back({std::move(log), std::make_shared<const LogIndex>(std::move(*index))});
    } catch (const std::runtime_error& error) {
      problems.push_back(Reason(error, file));
    }
  }
  if (opened.empty()) throw std::runtime_error(problems.empty() ? "it has no files" : problems.front());
  return std::make_shared<const RecordedFlight>(std::move(opened), std::move(problems));
}

RecordingSummary Summarize(const RecordedFlight& flight) {
  RecordingSummary summary;
  summary.start_utime = flight.start();
  summary.duration_s = flight.duration_s();
  summary.vehicles = VehiclesOf(flight);
  for (const auto& part : flight.parts()) {
    for (const auto& one : part.index->flights) {
      if (summary.scenario.empty()) summary.scenario = one.scenario;
    }
    summary.markers += static_cast<int>(
        std::ranges::count(part.index->told, recording::kMarkerCode, &recording::ToldEvent::code));
  }
  for (const auto& alarm : flight.Alarms()) {
    ++summary.alarms;
    summary.warnings += alarm.severity == event_t::WARNING ? 1 : 0;
  }
  return summary;
}

}  // namespace skein::playback

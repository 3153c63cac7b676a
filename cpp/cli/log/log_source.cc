#include "cli/log/log_source.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "cli/station.h"
#include "config/scenario.h"
#include "recording/log_clock.h"

namespace skein::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

constexpr std::uint64_t kLookEveryBytes = 1 << 20;
constexpr std::int64_t kShowEvery_ms = 200;

recording::Recording Open(const std::string& file) {
  try {
    return recording::Recording(file);
  } catch (const std::runtime_error& error) {
    throw config::ConfigError(error.what());
  }
}

std::int64_t NowMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

LogSource::LogSource(const std::string& file) : file_(file), recording_(Open(file)) {}

std::vector<std::filesystem::path> LogSource::parts() const {
  std::vector<std::filesystem::path> files;
  for (const auto& part : recording_.parts()) files.push_back(part->file());
  return files;
}

std::string LogSource::name() const {
  const std::string name = std::filesystem::path(file_).filename().string();
  const std::size_t end = name.find(".lcm");
  return end == std::string::npos || end == 0 ? name : name.substr(0, end);
}

void LogSource::ForEach(const Use& use) {
  const auto total = static_cast<double>(recording_.bytes());
  Progress progress("reading " + std::filesystem::path(file_).filename().string());
  recording::RecordingReader reader(recording_);
  recording::LogClock clock;
  std::optional<bus::Utime> start;
  std::uint64_t next_look = 0;
  while (const auto event = reader.Next()) {
    const bus::Utime utime = clock.Read(event->utime);
    if (!start) start = utime;
    if (!use(*event, bus::ToSeconds(utime - *start))) break;
    if (reader.bytes_read() < next_look) continue;
    next_look = reader.bytes_read() + kLookEveryBytes;
    ThrowIfInterrupted();
    progress.Show(static_cast<double>(reader.bytes_read()) / total);
  }
  Note(reader);
}

void LogSource::Note(const recording::RecordingReader& reader) {
  damage_ = reader.damage();
  damaged_bytes_ = reader.damaged_bytes();
}

void LogSource::TellProblems() const {
  for (const std::string& problem : recording_.problems()) fmt::print(stderr, "skein: {}\n", problem);
  if (damaged_bytes_ > 0) {
    fmt::print(stderr, "skein: {}: {} bytes of it are damaged and left out; `skein log info` says where\n",
               file_, damaged_bytes_);
  }
}

Progress::Progress(std::string what)
    : what_(std::move(what)),
      is_shown_(isatty(STDERR_FILENO) == 1 && isatty(STDOUT_FILENO) == 0),
      next_ms_(NowMs() + kShowEvery_ms) {}

Progress::~Progress() {
  if (wrote_) fmt::print(stderr, "\r\033[K");
}

void Progress::Show(double share) {
  if (!is_shown_ || NowMs() < next_ms_) return;
  next_ms_ = NowMs() + kShowEvery_ms;
  wrote_ = true;
  fmt::print(stderr, "\r{}: {:.0f}%", what_, 100 * share);
  std::fflush(stderr);
}

void CatchInterrupts() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
}

void ThrowIfInterrupted() {
  if (interrupted != 0) throw Interrupted("interrupted");
}

}  // namespace skein::cli

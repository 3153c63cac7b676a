#include "playback/recording_library.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

#include "playback/open_recording.h"

namespace skein::playback {
namespace {

// Linux has a nice value for each thread.
constexpr int kNice = 10;
// One that grows is not read again before.
constexpr bus::Utime kReadAgainAfter = 10 * bus::kSecond;

bus::Utime Steady() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

RecordingLibrary::RecordingLibrary(std::filesystem::path folder, std::string only)
    : folder_(std::move(folder)),
      only_(std::move(only)),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

RecordingLibrary::~RecordingLibrary() {
  thread_.request_stop();
  thread_.join();
}

std::vector<RecordingLibrary::Listed> RecordingLibrary::List() {
  std::vector<RecordingFiles> found;
  if (only_.empty()) {
    found = FindRecordings(folder_);
  } else if (auto files = FindRecording(folder_, only_, true)) {
    found.push_back(std::move(*files));
  }
  std::vector<Listed> list;
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const auto& item) {
    return item.second.state != Entry::State::kReading &&
           std::ranges::none_of(found, [&](const RecordingFiles& files) { return files.name == item.first; });
  });
  for (const RecordingFiles& files : found) {
    // What is being recorded is read when somebody wants to see it.
    const Entry& entry = files.recording_now ? entries_[files.name] : Update(files, false);
    list.push_back({files, entry.summary, entry.progress, entry.problem});
  }
  const auto begin = [](const Listed& one) {
    return one.summary ? one.summary->start_utime : one.files.changed;
  };
  std::ranges::stable_sort(list, std::ranges::greater(), begin);
  changed_.notify_all();
  return list;
}

std::optional<RecordingFiles> RecordingLibrary::Find(const std::string& name) const {
  if (!only_.empty() && name != only_) return std::nullopt;
  return FindRecording(folder_, name, !only_.empty());
}

std::optional<RecordingLibrary::Opened> RecordingLibrary::Open(const std::string& name) {
  const auto files = Find(name);
  if (!files) return std::nullopt;
  const std::lock_guard lock(mutex_);
  Entry& entry = Update(*files, true);
  entry.used = ++uses_;
  changed_.notify_all();
  if (entry.state == Entry::State::kRead) return Opened{entry.flight, 1, entry.problem};
  return Opened{nullptr, entry.progress, ""};
}

RecordingLibrary::Entry& RecordingLibrary::Update(const RecordingFiles& files, bool wanted) {
  using State = Entry::State;
  Entry& entry = entries_[files.name];
  const bool read = entry.state == State::kRead;
  const bool has_changed = read && entry.files != files && Steady() - entry.read_at > kReadAgainAfter;
  const bool closed = read && wanted && !entry.flight && entry.problem.empty();
  if (entry.state == State::kNew || has_changed || closed) {
    entry.state = State::kWaiting;
    entry.files = files;
    entry.progress = 0;
  }
  if (entry.state != State::kRead) entry.wanted = entry.wanted || wanted;
  return entry;
}

std::string RecordingLibrary::Remove(const std::string& name) {
  const auto files = Find(name);
  if (!files) return "there is no such recording";
  if (files->recording_now) return "it is being recorded now";
  std::string problem = RemoveRecording(folder_, *files);
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(name);
  if (entry != entries_.end() && entry->second.state != Entry::State::kReading) entries_.erase(entry);
  return problem;
}

void RecordingLibrary::Run(const std::stop_token& stop) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  while (!stop.stop_requested()) {
    std::string name;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [&] { return !(name = Next()).empty(); });
      if (stop.stop_requested()) return;
      entries_[name].state = Entry::State::kReading;
    }
    Read(name, stop);
  }
}

std::string RecordingLibrary::Next() const {
  std::string next;
  for (const auto& [name, entry] : entries_) {
    if (entry.state != Entry::State::kWaiting) continue;
    if (entry.wanted) return name;
    if (next.empty()) next = name;
  }
  return next;
}

void RecordingLibrary::Read(const std::string& name, const std::stop_token& stop) {
  const auto go_on = [&](double progress) {
    const std::lock_guard lock(mutex_);
    Entry& entry = entries_[name];
    entry.progress = progress;
    // Somebody who waits comes first; what is done in the background begins anew after.
    const bool others_wait = std::ranges::any_of(entries_, [](const auto& item) {
      return item.second.wanted && item.second.state == Entry::State::kWaiting;
    });
    return !stop.stop_requested() && (entry.wanted || !others_wait);
  };
  std::vector<std::filesystem::path> parts;
  {
    const std::lock_guard lock(mutex_);
    parts = entries_[name].files.parts;
  }
  std::shared_ptr<const RecordedFlight> flight;
  std::string problem;
  bool given_up = false;
  try {
    flight = OpenRecording(parts, go_on);
    given_up = !flight;
  } catch (const std::exception& error) {
    problem = error.what();
    spdlog::info("{} cannot be opened: {}", name, problem);
  }
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[name];
  entry.state = given_up ? Entry::State::kWaiting : Entry::State::kRead;
  if (given_up) return;
  entry.problem = problem;
  entry.progress = 1;
  entry.read_at = Steady();
  entry.summary = flight ? std::optional(Summarize(*flight)) : std::nullopt;
  // What was read in the background is known now, and need not stay open.
  entry.flight = entry.wanted ? flight : nullptr;
  entry.wanted = false;
  CloseUnused();
}

void RecordingLibrary::CloseUnused() {
  std::vector<Entry*> unused;
  for (auto& [name, entry] : entries_) {
    if (entry.flight && entry.flight.use_count() == 1) unused.push_back(&entry);
  }
  std::ranges::sort(unused, std::ranges::greater(), [](const Entry* entry) { return entry->used; });
  for (std::size_t i = kKeptOpen; i < unused.size(); ++i) unused[i]->flight.reset();
}

}  // namespace skein::playback

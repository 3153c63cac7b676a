#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "playback/recorded_flight.h"
#include "playback/recording_folder.h"

namespace skein::playback {

/// What the list tells of a recording that has been indexed.
struct RecordingSummary {
  std::string scenario;
  bus::Utime start_utime = 0;
  double duration_s = 0;
  int vehicles = 0;
  int alarms = 0;
  int warnings = 0;  ///< alarms of that severity
  int markers = 0;
};

/// The recordings of a folder. Any thread may call; none waits: recordings are indexed, or their indexes
/// loaded, on a thread of its own, with a nice value above those that fly and show.
class RecordingLibrary {
 public:
  /// @param only "": all of the folder, else the name of the one recording.
  explicit RecordingLibrary(std::filesystem::path folder, std::string only = "");
  ~RecordingLibrary();
  RecordingLibrary(const RecordingLibrary&) = delete;
  RecordingLibrary& operator=(const RecordingLibrary&) = delete;

  struct Listed {
    RecordingFiles files;
    std::optional<RecordingSummary> summary;  ///< none: not indexed yet
    double progress = 0;                      ///< of indexing
    std::string problem;                      ///< why it cannot be opened
  };
  /// All, the newest first. Those that are not indexed will be, in the background.
  std::vector<Listed> List();

  struct Opened {
    std::shared_ptr<const RecordedFlight> flight;  ///< null: not yet, or never
    double progress = 0;                           ///< until there is one
    std::string problem;                           ///< why there will be none
  };
  /// Begins to open it, before all that is done in the background; ask again. None: there is no such one.
  std::optional<Opened> Open(const std::string& name);

  /// Its files now.
  std::optional<RecordingFiles> Find(const std::string& name) const;

  /// Returns why it could not be removed, "" when all is gone.
  std::string Remove(const std::string& name);

  const std::filesystem::path& folder() const { return folder_; }
  const std::string& only() const { return only_; }

  /// So many recordings stay open that nobody looks at.
  static constexpr std::size_t kKeptOpen = 2;

 private:
  struct Entry {
    RecordingFiles files;  ///< as they were when it was read
    enum class State { kNew, kWaiting, kReading, kRead } state = State::kNew;
    bool wanted = false;  ///< by somebody who waits, so before others
    double progress = 0;
    std::string problem;
    std::optional<RecordingSummary> summary;
    std::shared_ptr<const RecordedFlight> flight;
    std::int64_t used = 0;  ///< the largest is the last
    bus::Utime read_at = 0;
  };

  Entry& Update(const RecordingFiles& files, bool wanted);
  void Run(const std::stop_token& stop);
  std::string Next() const;
  void Read(const std::string& name, const std::stop_token& stop);
  void CloseUnused();

  std::filesystem::path folder_;
  std::string only_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::string, Entry> entries_;
  std::int64_t uses_ = 0;
  std::jthread thread_;  ///< last: it ends before what it uses
};

}  // namespace skein::playback

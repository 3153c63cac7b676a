#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "bus/events.h"

namespace skein::bus {

/// What a node must not lose when it is killed: a file that holds the old state or the new one, whatever
/// happens (files/atomic_file.h), with a checksum. Anything else in its place is set aside, and told of.
/// Belongs to the executor's thread; what takes long is written on one of its own.
class StateFile {
 public:
  /// @param file empty: nothing is kept. @param kind of state, a word; another kind is not read. @param
  /// events outlives this.
  StateFile(std::filesystem::path file, std::string kind, Events& events);
  /// What was saved last is on the disk afterwards.
  ~StateFile();
  StateFile(const StateFile&) = delete;
  StateFile& operator=(const StateFile&) = delete;

  bool kept() const { return !file_.empty(); }

  /// What was saved last; none when there is nothing, or something else.
  std::optional<std::string> Read();
  /// For a state that was read and makes no sense: renames the file to FILE.damaged, and tells.
  void SetAside(const std::string& why);

  /// Soon, a newer one instead of one that waits still. That it failed is told when it is next called.
  void Save(std::string state);
  /// Returns when it is on the disk, or cannot be: for what has been promised to somebody.
  void SaveNow(std::string state);

 private:
  void WriteAll();
  void TellProblem(const std::string& problem);

  const std::filesystem::path file_;
  const std::string kind_;
  Events& events_;
  bool told_ = false;  ///< that it cannot be written

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> waiting_;  ///< to be written
  bool writing_ = false;
  bool ends_ = false;
  std::string problem_;  ///< of the last attempt, "" when it was written
  std::thread thread_;   ///< last: it uses the others
};

}  // namespace skein::bus

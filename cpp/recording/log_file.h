#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/executor.h"

namespace skein::recording {

/// A file that lcm-logger wrote, or anything else that writes LCM logs; opened for reading alone. Threads may
/// share it, each with a LogReader of its own. Read with pread, never mapped: a file that somebody cuts short
/// meanwhile is damage, not SIGBUS, and a log of any size takes no memory.
class LogFile {
 public:
  /// Throws std::runtime_error with the path and the reason: missing, no permission, a folder, empty, or no
  /// event in its first 64 MB.
  explicit LogFile(std::filesystem::path file);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// Size when opened, or at the last Refresh().
  std::uint64_t bytes() const { return bytes_; }
  /// Looks how long the file is now; readers then go on into what was written since. Not beside another
  /// thread that reads.
  void Refresh();

 private:
  friend class LogReader;
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
};

/// One message as it was logged. The views are good until the reader moves on.
struct LogEvent {
  std::uint64_t offset = 0;  ///< of its header in the file
  std::int64_t number = 0;   ///< counted by whoever wrote the log, usually from 0
  bus::Utime utime = 0;      ///< when it was logged
  std::string_view channel;  ///< 1 to 999 bytes, any bytes
  std::span<const std::byte> data;

  /// What it takes in the file.
  std::uint64_t bytes() const;
};

/// A stretch of a file that holds no event that could be read.
struct Damage {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::string reason;                    ///< for people
  std::optional<bus::Utime> last_utime;  ///< of the last event before it
};

/// Walks through the events of a log, past whatever is damaged: no length in the file is believed unless an
/// event or the end of the file comes after it, or nothing else can be read in its place; holes of a sparse
/// file are jumped over.
class LogReader {
 public:
  /// @param offset of an event's header, as LogEvent tells it; or anywhere: the first event after it is then
  /// the first one, and what is skipped is not reported. @param log outlives the reader.
  explicit LogReader(const LogFile& log, std::uint64_t offset = 0);

  /// The next event, none at the end of the file.
  std::optional<LogEvent> Next();

  /// Where Next() looks for an event.
  std::uint64_t offset() const { return offset_; }
  /// Found so far, in the order of the file: the first thousand. An event that is cut short by the end of the
  /// file is the last one, until the file has grown.
  std::vector<Damage> damage() const;
  /// All that were found, listed or not.
  std::size_t damage_count() const { return damage_count_ + (tail_ ? 1 : 0); }
  std::uint64_t damaged_bytes() const { return damaged_bytes_ + (tail_ ? tail_->bytes : 0); }

 private:
  friend class LogFile;
  struct Header;
  std::span<const std::byte> Window(std::uint64_t offset, std::uint64_t size);
  std::optional<Header> ReadHeader(std::uint64_t offset);
  bool Follows(std::uint64_t end);
  std::optional<Header> FirstConfirmed(std::uint64_t from);
  std::optional<Header> FirstBelievable(std::uint64_t from);
  std::optional<std::uint64_t> FindMagic(std::uint64_t from, std::uint64_t end);
  std::optional<LogEvent> Take(const Header& header);
  void Report(std::uint64_t offset, std::uint64_t bytes, std::string reason);

  /// What the last search for a confirmed event found, so that damage is searched once only.
  struct Confirmed {
    std::uint64_t from = 0;
    std::uint64_t log_bytes = 0;
    std::optional<std::uint64_t> offset;
  };

  const LogFile& log_;
  std::uint64_t offset_;
  bool reports_;                        ///< whether what is skipped now is damage
  std::uint64_t search_bytes_ = ~0ULL;  ///< how much may still be searched
  std::optional<bus::Utime> last_utime_;
  std::optional<Confirmed> confirmed_;
  std::vector<std::byte> window_;
  std::uint64_t window_offset_ = 0;
  std::uint64_t window_bytes_ = 0;
  std::vector<Damage> damage_;
  std::optional<Damage> tail_;
  std::size_t damage_count_ = 0;
  std::uint64_t damaged_bytes_ = 0;
};

}  // namespace skein::recording

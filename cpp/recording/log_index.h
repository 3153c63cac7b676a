#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/executor.h"
#include "recording/history.h"
#include "recording/log_file.h"

namespace skein::recording {

/// A place from which the log can be read.
struct SeekPoint {
  bus::Utime utime = 0;
  std::uint64_t offset = 0;
  bus::Utime shift = 0;  ///< of the LogClock there
};

struct ChannelCount {
  std::string name;
  std::int64_t count = 0;
  std::int64_t bytes = 0;        ///< of the messages themselves
  std::int64_t undecodable = 0;  ///< of a known channel: what its receivers would refuse
  bool known = false;            ///< a type of Skein's was on it, or it is one of its own
  bus::Utime first = 0;
  bus::Utime last = 0;
};

/// The code of the EVENT that is somebody's note.
inline constexpr const char* kMarkerCode = "marker";

/// A message of EVENT.
struct ToldEvent {
  bus::Utime utime = 0;      ///< when it was logged
  std::uint64_t offset = 0;  ///< of the message in the log
  std::int8_t severity = 0;
  std::string code;
  std::string text;  ///< cut at 500 bytes
};

/// An alarm, when it was first seen on ALARMS.
struct RaisedAlarm {
  bus::Utime utime = 0;
  std::int64_t session_id = 0;
  std::int64_t id = 0;
  std::int8_t severity = 0;
  std::string condition;
  std::string text;
};

/// What is repeated on a channel comes again within this, unless its sender is gone or cannot be heard.
bus::Utime LongestPause(std::string_view channel);

/// The last message (or set of chunks) of something that is repeated, before it paused for longer than that,
/// or for good: what receivers go on showing, and what is no longer found just before a later moment.
struct HeldMessage {
  std::uint32_t stream = 0;  ///< index of LogIndex::streams
  std::int32_t messages = 1;
  bus::Utime utime = 0;
  std::uint64_t offset = 0;  ///< of the first of them
};

/// From one start of a scenario to the next.
struct IndexedFlight {
  bus::Utime utime = 0;        ///< when it was first heard of
  bus::Utime start_utime = 0;  ///< time of its tick 0, as its roster tells
  std::string scenario{};
  std::int32_t vehicles = 0;
  HistorySamples samples{};
};

struct IndexedDamage {
  bus::Utime utime = 0;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::string reason;
};

/// What is where in one log file, found in one pass. Times are those of LogClock; lists are in order of time.
struct LogIndex {
  std::uint64_t bytes = 0;  ///< of the log up to where it was read
  std::int64_t events = 0;  ///< messages of any channel
  bus::Utime first = 0;
  bus::Utime last = 0;
  std::vector<SeekPoint> points;  ///< the first event, then one each 256 kB
  std::vector<ChannelCount> channels;
  std::vector<ToldEvent> told;
  std::vector<RaisedAlarm> alarms;
  std::vector<std::string> streams;  ///< "FORMATION/2": channel, and whose
  std::vector<HeldMessage> held;     ///< in order of time within each stream
  std::vector<IndexedFlight> flights;
  std::vector<IndexedDamage> damage;
  std::uint64_t damaged_bytes = 0;

  /// More than so many EVENTs, alarms or stretches of damage are not listed (the last "damage" says so).
  static constexpr std::size_t kMostListed = 100'000;
};

/// Reads the whole log. `go_on` is told the progress (0 to 1) now and then, and ends it by returning false:
/// then there is no result. Nothing in a log makes it fail.
std::optional<LogIndex> IndexLog(const LogFile& log, const std::function<bool(double)>& go_on);

}  // namespace skein::recording

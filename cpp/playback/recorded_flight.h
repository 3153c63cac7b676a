#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recording/log_clock.h"
#include "recording/log_file.h"
#include "recording/log_index.h"

namespace skein::playback {

/// An event and its time, by the recording's clock.
struct TimedEvent {
  bus::Utime utime = 0;
  recording::LogEvent event;
};

/// A recording that has been opened: the parts of it, each with its index, joined. Never changes, so threads
/// may share it.
class RecordedFlight {
 public:
  struct Part {
    std::shared_ptr<const recording::LogFile> log;
    std::shared_ptr<const recording::LogIndex> index;
    /// Added to the times of the part, so that time always rises; set by RecordedFlight.
    bus::Utime shift = 0;
  };

  /// @param parts in order, one at least. @param problems of parts that are missing, for people.
  explicit RecordedFlight(std::vector<Part> parts, std::vector<std::string> problems = {});

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<std::string>& problems() const { return problems_; }
  /// Time of the first and of the last event.
  bus::Utime start() const;
  bus::Utime end() const;
  double duration_s() const { return bus::ToSeconds(end() - start()); }

  /// A message somewhere in it.
  struct Place {
    std::size_t part = 0;
    std::uint64_t offset = 0;
    bus::Utime utime = 0;
    int messages = 1;     ///< so many of its channel belong together from there on
    std::string channel;  ///< of those
  };

  /// What was still shown at `utime` though it was last said long before, in order of time: more than
  /// LeadOf() its channel.
  std::vector<Place> HeldAt(bus::Utime utime) const;

  /// Whatever is repeated on a channel, and not held, is found within so much before any moment.
  static bus::Utime LeadOf(std::string_view channel) { return recording::LongestPause(channel) * 7 / 5; }

  /// The last EVENTs before `utime`, in order of time.
  std::vector<Place> EventsBefore(bus::Utime utime, std::size_t most) const;

  /// All alarms, by the recording's time.
  std::vector<recording::RaisedAlarm> Alarms() const;

  /// The flight that was on at `utime`, none when there is none at all. Its times lack the part's shift.
  const recording::IndexedFlight* FlightAt(bus::Utime utime) const;

 private:
  std::vector<Part> parts_;
  std::vector<std::string> problems_;
};

/// Reads a recording from some moment on, part after part.
class Cursor {
 public:
  /// At the first event at or after `utime`. `flight` outlives it.
  Cursor(const RecordedFlight& flight, bus::Utime utime);
  /// At a message whose place is known.
  Cursor(const RecordedFlight& flight, const RecordedFlight::Place& place);

  /// The event where it stands, none at the end. Good until Advance().
  const std::optional<TimedEvent>& current() const { return current_; }
  void Advance();

 private:
  void Enter(std::size_t part, std::uint64_t offset, recording::LogClock clock);

  const RecordedFlight* flight_;
  std::size_t part_ = 0;
  std::optional<recording::LogReader> reader_;
  recording::LogClock clock_;
  std::optional<TimedEvent> current_;
};

}  // namespace skein::playback

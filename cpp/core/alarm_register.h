#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/alert_levels.h"

namespace skein {

/// Something that is wrong for as long as it lasts.
struct AlarmCondition {
  std::string key;  ///< the same for as long as it is the same: "link:3", "proximity:2-5"
  AlertLevel severity = AlertLevel::kCaution;  ///< not kClear
  std::string text;                            ///< for people
  int vehicle_id = 0;                          ///< 0: no single UAV
  int other_vehicle_id = 0;                    ///< the other one of a pair
  int formation_id = 0;
};

/// The numbers are those of ALARMS.
enum class AlarmState { kUnacknowledged = 0, kAcknowledged = 1, kEnded = 2, kShelved = 3, kOver = 4 };

/// One occurrence of a condition. Times are utimes [us].
struct Alarm {
  /// What an operator did, when (or until when), and who it was.
  struct Act {
    std::int64_t utime = 0;
    std::string by;
  };

  std::int64_t id = 0;
  AlarmCondition condition;  ///< as it was raised; the severity is the worst since then
  std::int64_t raised_utime = 0;
  std::optional<std::int64_t> ended_utime;
  std::optional<Act> acknowledged;
  std::optional<Act> shelved_until;
  bool over = false;  ///< history

  AlarmState state() const;
};

/// The life of alarms, after ANSI/ISA-18.2 (its states in brackets):
///
///   Raise ──► kUnacknowledged (B) ──Acknowledge──► kAcknowledged (C) ──End──► kOver (A)
///                   └──End──► kEnded (D) ──Acknowledge──► kOver
///   any of these ──Shelve──► kShelved (G) ──Unshelve, or its time is over──► kUnacknowledged, or kOver when
///   it has ended
///
/// A condition that comes back or becomes worse is a new occurrence with a new id, unacknowledged; what was
/// there of it before goes into the history. So an acknowledgement can never mean something that its operator
/// has not seen. While it is shelved it may come and go unseen, but not become worse. One that becomes better
/// stays as it is.
///
/// Not thread-safe. Has no clock: the caller says what time it is.
class AlarmRegister {
 public:
  /// The condition is on. Nothing happens when it was, and no worse.
  void Raise(std::int64_t now, const AlarmCondition& condition);
  /// The condition is no longer on. Nothing happens when it was not.
  void End(std::int64_t now, const std::string& key);
  /// To be called often: shelves end by time.
  void Advance(std::int64_t now);

  enum class Result {
    kDone,
    kAlready,  ///< it was acknowledged, or is not shelved
    kOver,     ///< it is history
    kUnknown,  ///< there never was such an alarm, or it is forgotten
  };
  Result Acknowledge(std::int64_t now, std::int64_t id, const std::string& by);
  /// Those up to this id that are not shelved. Returns how many were not acknowledged.
  int AcknowledgeUpTo(std::int64_t now, std::int64_t id, const std::string& by);
  /// Again: sets the time anew. What an operator shelves is not acknowledged by it.
  Result Shelve(std::int64_t id, const Alarm::Act& until);
  Result Unshelve(std::int64_t now, std::int64_t id);

  /// Of any state; null: unknown.
  const Alarm* Find(std::int64_t id) const;
  /// All but the history, the most urgent first: unacknowledged, acknowledged, ended, shelved; the worst, the
  /// latest.
  std::vector<Alarm> open() const;
  /// The latest that are over, newest first.
  const std::deque<Alarm>& history() const { return history_; }

  struct Counts {
    std::array<int, 4> on{};              ///< by severity, not shelved
    std::array<int, 4> unacknowledged{};  ///< by severity, on or ended, not shelved
  };
  Counts counts() const;

  /// Goes on with the alarms of an earlier register. Only at the start, before anything is raised.
  void Restore(const std::vector<Alarm>& open, std::deque<Alarm> history, std::int64_t newest_id);

  std::int64_t newest_id() const { return newest_id_; }
  /// Rises with every change.
  std::int64_t revision() const { return revision_; }

  static constexpr std::size_t kHistory = 50;
  /// More that have ended are not kept for acknowledgement: the oldest go into the history.
  static constexpr std::size_t kMostEnded = 500;

 private:
  using Entry = std::map<std::string, Alarm>::iterator;

  Entry FindOpen(std::int64_t id);
  Result WhyNotOpen(std::int64_t id) const;
  void Acknowledge(Entry entry, std::int64_t now, const std::string& by);
  void Close(Entry entry, std::int64_t now);
  void BringBack(Entry entry, std::int64_t now);
  void LimitEnded(std::int64_t now);

  std::map<std::string, Alarm> open_;  ///< by key
  std::deque<Alarm> history_;
  std::int64_t newest_id_ = 0;
  std::int64_t revision_ = 0;
};

}  // namespace skein

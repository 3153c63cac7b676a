#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "bus/executor.h"
#include "monitor/alarm_desk.h"
#include "monitor/watched_uav.h"

namespace skein::monitor {

/// Which broken links are told one by one, and which together.
///
/// When the source of FLEET_STATE falls silent every link breaks, and all for one reason: that is one alarm,
/// `fleet_silent`, and one event, with how many they are. Links that had been told before stay as they are.
/// Once the fleet is heard again its links have kSettling to come back; those that have not are told then,
/// each by itself.
class LinkAlarms {
 public:
  /// A fleet that was silent before a restart is so until it is heard. @param heard_before whether there was
  /// one: then its silence is noticed, too, if it is never heard by this process.
  LinkAlarms(AlarmDesk& alarms, bus::Utime now, bool heard_before);

  /// FLEET_STATE has come.
  void HearFleet(bus::Utime now);
  /// To be called after each judgement of a UAV. Returns what is to be told of its link now.
  std::vector<Notice> Take(bus::Utime now, const WatchedUav& uav, WatchedUav::Judgement judgement);
  /// It is not watched any more.
  void Forget(const WatchedUav& uav);
  /// To be called often. @param watched how many UAVs there are. Returns what is to be told of the fleet.
  std::optional<Notice> Look(bus::Utime now, std::size_t watched);

  /// Silence of the fleet: so long that it explains a link that is late (2 s), whatever the rate of
  /// FLEET_STATE down to 1 Hz.
  static constexpr bus::Utime kExplains = 3 * bus::kSecond / 2;
  /// So long that it is an alarm.
  static constexpr bus::Utime kSilentAfter = 3 * bus::kSecond;
  /// A lost link is up after 3 s of proofs; then there is a second for what was late itself.
  static constexpr bus::Utime kSettling = 4 * bus::kSecond;

 private:
  bool Together(bus::Utime now) const;

  AlarmDesk& alarms_;
  std::optional<bus::Utime> heard_;         ///< FLEET_STATE, last
  std::optional<bus::Utime> heard_again_;   ///< the first one after a silence
  std::optional<bus::Utime> silent_since_;  ///< while `fleet_silent` is on
  std::set<int> told_;                      ///< whose alarm is on
  std::set<int> untold_;                    ///< whose link is broken as all were
};

}  // namespace skein::monitor

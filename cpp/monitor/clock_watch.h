#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/bus.h"
#include "monitor/alarm_desk.h"

namespace skein::monitor {

/// Raises an alarm while the clock of another node (HEARTBEAT) is off from ours: events, alarms and
/// recordings of several hosts are then hard to read together. Links are judged by times of one clock alone,
/// so nothing else comes of it. And one while the wall clock of this host is not what Skein goes by, because
/// it was set meanwhile.
class ClockWatch {
 public:
  ClockWatch(bus::Bus& bus, AlarmDesk& alarms);

  /// Off by more than this is an alarm, until it is off by less than half of it.
  static constexpr bus::Utime kMost = bus::kSecond;
  /// In all heartbeats for so long, by ours: one may be late for other reasons, and when this process was
  /// stopped meanwhile, many at once.
  static constexpr bus::Utime kOffFor = 3 * bus::kSecond / 2;

 private:
  struct Offset {
    std::optional<bus::Utime> off_since;
    bool alarm = false;
  };
  void Hear(const std::string& node, bus::Utime sent, bus::Utime now);
  void LookAtWallClock(bus::Utime ahead);

  AlarmDesk& alarms_;
  std::map<std::string, Offset> nodes_;
  bool wall_clock_alarm_ = false;
};

}  // namespace skein::monitor

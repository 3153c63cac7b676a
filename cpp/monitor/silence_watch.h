#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/bus.h"
#include "monitor/alarm_desk.h"

namespace skein::monitor {

/// Raises alarms when a node (HEARTBEAT) or the source of the fleet (FLEET_STATE) falls silent. What was
/// never heard is not missed: a station may do without it.
class SilenceWatch {
 public:
  SilenceWatch(bus::Bus& bus, AlarmDesk& alarms);

 private:
  void Look();

  bus::Bus& bus_;
  AlarmDesk& alarms_;
  std::map<std::string, bus::Utime> nodes_;  ///< when last heard
  std::optional<bus::Utime> fleet_;          ///< likewise
};

}  // namespace skein::monitor

#pragma once

#include <map>
#include <string>

#include "bus/bus.h"
#include "monitor/alarm_desk.h"
#include "monitor/held_up.h"

namespace skein::monitor {

/// Raises alarms when a node (HEARTBEAT) falls silent. What was never heard is not missed: a station may do
/// without it.
class SilenceWatch {
 public:
  SilenceWatch(bus::Bus& bus, AlarmDesk& alarms);

 private:
  void Look();

  bus::Bus& bus_;
  AlarmDesk& alarms_;
  struct Node {
    bus::Utime heard = 0;  ///< last
    int times = 0;
  };
  std::map<std::string, Node> nodes_;
  HeldUp held_up_{2 * bus::kSecond};  // a heartbeat of everybody
};

}  // namespace skein::monitor

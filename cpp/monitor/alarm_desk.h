#pragma once

#include <cstdint>
#include <skein/alarm_command_t.hpp>
#include <string>

#include "bus/bus.h"
#include "bus/command_inbox.h"
#include "bus/events.h"
#include "core/alarm_register.h"

namespace skein::monitor {

/// The alarms on the bus: sends ALARMS, obeys CMD_ALARM. Nothing is kept beyond the process: after a restart
/// what is still wrong is raised again, unacknowledged.
class AlarmDesk {
 public:
  AlarmDesk(bus::Bus& bus, bus::Events& events);

  /// As AlarmRegister has them. Sent soon, and together with what else happens at this moment.
  void Raise(const AlarmCondition& condition);
  void End(const std::string& key);

 private:
  void Look();
  void Publish();
  bus::Answer Obey(const alarm_command_t& command);
  bus::Answer AcknowledgeAll(const alarm_command_t& command, const std::string& by);
  /// What is done with each alarm that a command names.
  AlarmRegister::Result Apply(const alarm_command_t& command, std::int64_t id, const std::string& by);

  bus::Utime Now() const { return bus_.executor().Now(); }

  bus::Bus& bus_;
  bus::Events& events_;
  bus::CommandInbox inbox_;
  AlarmRegister alarms_;
  std::int64_t sequence_ = 0;
  std::int64_t sent_revision_ = 0;
  bus::Utime sent_ = 0;
};

}  // namespace skein::monitor

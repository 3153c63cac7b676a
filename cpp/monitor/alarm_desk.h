#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <skein/alarm_command_t.hpp>
#include <string>
#include <utility>

#include "bus/bus.h"
#include "bus/command_inbox.h"
#include "bus/events.h"
#include "bus/state_file.h"
#include "core/alarm_register.h"

namespace skein::monitor {

/// The alarms on the bus: sends ALARMS, obeys CMD_ALARM. With a state file they are as they were after a
/// restart: ids, who has acknowledged and shelved what, the history. What has ended meanwhile ends kConfirm
/// later, when it has not been raised again.
class AlarmDesk {
 public:
  /// @param state_file "": nothing is kept, and what is still wrong after a restart is raised again,
  /// unacknowledged.
  AlarmDesk(bus::Bus& bus, bus::Events& events, const std::filesystem::path& state_file);

  /// As AlarmRegister has them. Sent soon, and together with what else happens at this moment.
  void Raise(const AlarmCondition& condition);
  void End(const std::string& key);
  /// Keys of alarms that were on before a restart, and have not been raised again yet.
  const std::set<std::string>& unconfirmed() const { return unconfirmed_; }
  /// Nothing can be heard that would confirm them or not: they have their time from now on.
  void ConfirmLater() { confirm_by_ = Now() + kConfirm; }

  /// Something else that must not be lost is kept in the same file. @param encode is asked at each saving.
  void AlsoKeep(std::function<std::string()> encode) { encode_more_ = std::move(encode); }
  /// What it was before a restart; empty: there was nothing, or it is too old.
  const std::string& also_kept() const { return also_kept_; }

  /// Twice the time in which a lost link is found.
  static constexpr bus::Utime kConfirm = 10 * bus::kSecond;
  /// An older state is of another flight.
  static constexpr bus::Utime kOldestState = 60 * bus::kSecond;

 private:
  void Restore();
  std::string Encoded() const;
  void SaveNow() {
    if (state_file_.kept()) state_file_.SaveNow(Encoded());
  }
  void Look();
  void Publish();
  bus::Answer Obey(const alarm_command_t& command);
  bus::Answer AcknowledgeAll(const alarm_command_t& command, const std::string& by);
  /// What is done with each alarm that a command names.
  AlarmRegister::Result Apply(const alarm_command_t& command, std::int64_t id, const std::string& by);

  bus::Utime Now() const { return bus_.executor().Now(); }

  bus::Bus& bus_;
  bus::Events& events_;
  bus::StateFile state_file_;
  bus::CommandInbox inbox_;
  AlarmRegister alarms_;
  std::function<std::string()> encode_more_;
  std::string also_kept_;
  std::int64_t sequence_ = 0;
  std::int64_t sent_revision_ = 0;
  std::set<std::string> unconfirmed_;
  bus::Utime confirm_by_ = 0;
  bus::Utime sent_ = 0;
};

}  // namespace skein::monitor

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/executor.h"
#include "core/alarm_register.h"
#include "core/dead_reckoning.h"
#include "core/link_watch.h"

namespace skein::monitor {

/// Something to tell on EVENT.
struct Notice {
  std::int8_t severity = 0;  ///< a constant of event_t
  std::string code;
  std::string text;
  int vehicle_id = 0;
  int formation_id = 0;
};

/// One UAV: its link, what was last said of that link, and where it is.
class WatchedUav {
 public:
  WatchedUav(int id, std::string callsign, bool in_roster, bus::Utime now, const LinkTimes& times);

  int id() const { return id_; }
  const std::string& callsign() const { return callsign_; }
  std::string alarm_key() const;
  bool in_roster() const { return in_roster_; }
  void Enrol(const std::string& callsign);

  struct Heard {
    bool credible = true;          ///< false: its clock has jumped, or it is where it cannot have flown to
    std::optional<Notice> notice;  ///< of that, each again after 10 s at the earliest
  };
  Heard Hear(bus::Utime now, const Telemetry& telemetry);
  /// Goes on with the watch of before a restart. Only at the start.
  void Recall(bus::Utime now, const LinkWatch::Memory& memory) { watch_.Recall(now, memory); }
  /// It may be anywhere when it is heard next.
  void ForgetPlace() { last_.reset(); }
  void HearCommand(bus::Utime now, std::int64_t session_id) { watch_.Command(now, session_id); }

  struct Judgement {
    bool changed = false;  ///< a direction is in another state than at the last judgement
    std::vector<Notice> notices;
    std::optional<AlarmCondition> alarm;  ///< none: the link is in order, or as it was
  };
  /// To be called often. Late, lost and restored are told once each. When both directions fail, the loss of
  /// the downlink is told: what became of the uplink cannot be known without it.
  Judgement Judge(bus::Utime now);

  const LinkWatch& watch() const { return watch_; }

  /// What is wrong with its link now, as of the last judgement; empty: nothing.
  std::vector<Notice> Fault(bus::Utime now) const;
  /// For a link that is late or lost, with the words of the notices about it; none: it is neither.
  std::optional<AlarmCondition> LinkAlarm(const std::vector<Notice>& notices) const;

  /// Where it is now; none: never heard. A UAV that is not heard has an uncertainty.
  std::optional<Estimate> Locate(bus::Utime now, const UncertaintyGrowth& growth) const;

 private:
  Notice Tell(std::int8_t severity, std::string code, std::string text) const;
  static bool HasLeapt(const Telemetry& before, const Telemetry& after);
  static bool TimeHasJumped(bus::Utime elapsed, const Telemetry& before, const Telemetry& after);
  Notice TellLeap(const Telemetry& before, const Telemetry& after) const;
  std::string DownlinkFault(bus::Utime now) const;
  std::string UplinkFault() const;

  int id_;
  std::string callsign_;
  bool in_roster_;
  LinkWatch watch_;
  std::optional<bus::Utime> heard_;  ///< anything, fresh or not
  std::optional<Telemetry> last_;    ///< of what was heard
  bus::Utime leap_told_ = 0;
  bus::Utime jump_told_ = 0;

  // As of the last judgement.
  LinkState downlink_ = LinkState::kUnknown;
  LinkState uplink_ = LinkState::kUnknown;
  std::optional<bus::Utime> bad_since_;  ///< last proof before the loss
};

}  // namespace skein::monitor

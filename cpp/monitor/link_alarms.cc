#include "monitor/link_alarms.h"

#include <spdlog/fmt/fmt.h>

#include <skein/event_t.hpp>
#include <string>
#include <utility>

namespace skein::monitor {
namespace {

constexpr const char* kFleetSilent = "fleet_silent";

}  // namespace

LinkAlarms::LinkAlarms(AlarmDesk& alarms, bus::Utime now, bool heard_before) : alarms_(alarms) {
  if (heard_before) heard_ = now;
  if (alarms.unconfirmed().contains(kFleetSilent)) heard_ = now - kSilentAfter;
}

void LinkAlarms::HearFleet(bus::Utime now) {
  // Where telemetry stutters for long, what is lost is told between two settlings.
  const bool settled = !heard_again_ || now - *heard_again_ >= 2 * kSettling;
  if (heard_ && now - *heard_ >= kExplains && settled) heard_again_ = now;
  heard_ = now;
}

bool LinkAlarms::Together(bus::Utime now) const {
  return heard_ && (now - *heard_ >= kExplains || (heard_again_ && now - *heard_again_ < kSettling));
}

std::vector<Notice> LinkAlarms::Take(bus::Utime now, const WatchedUav& uav, WatchedUav::Judgement judgement) {
  const int id = uav.id();
  if (!told_.contains(id) && Together(now)) {
    if (!judgement.changed) return {};
    // What breaks now does so with all the others; what was broken with them and is whole again was never
    // told.
    if (judgement.alarm) {
      untold_.insert(id);
      return {};
    }
    return untold_.erase(id) > 0 ? std::vector<Notice>() : std::move(judgement.notices);
  }
  if (untold_.erase(id) > 0) {
    // The fleet is heard again, and this one is not.
    judgement.notices = uav.Fault(now);
    judgement.alarm = uav.LinkAlarm(judgement.notices);
  } else if (!judgement.changed) {
    return std::move(judgement.notices);
  }
  if (judgement.alarm) {
    told_.insert(id);
    alarms_.Raise(*judgement.alarm);
  } else {
    told_.erase(id);
    alarms_.End(uav.alarm_key());
  }
  return std::move(judgement.notices);
}

void LinkAlarms::Forget(const WatchedUav& uav) {
  told_.erase(uav.id());
  untold_.erase(uav.id());
  alarms_.End(uav.alarm_key());
}

std::optional<Notice> LinkAlarms::Look(bus::Utime now, std::size_t watched) {
  if (!heard_) return std::nullopt;
  const bool silent = now - *heard_ >= kSilentAfter;
  if (silent) alarms_.ConfirmLater();
  if (silent == silent_since_.has_value()) return std::nullopt;
  if (silent) {
    silent_since_ = *heard_;
    // None before the roster has come.
    const std::string of =
        watched == 0 ? "" : fmt::format(" from any of {} UAV{}", watched, watched == 1 ? "" : "s");
    const std::string text = fmt::format("no telemetry{}: the source of FLEET_STATE has fallen silent", of);
    alarms_.Raise({kFleetSilent, AlertLevel::kWarning, text});
    return Notice{event_t::WARNING, kFleetSilent, text, 0, 0};
  }
  const double silence_s = bus::ToSeconds(now - *silent_since_);
  silent_since_.reset();
  alarms_.End(kFleetSilent);
  return Notice{event_t::INFO, "fleet_heard", fmt::format("telemetry is back after {:.1f} s", silence_s), 0,
                0};
}

}  // namespace skein::monitor

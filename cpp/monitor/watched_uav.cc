#include "monitor/watched_uav.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <skein/event_t.hpp>
#include <utility>

namespace skein::monitor {
namespace {

// Telemetry that still comes this often, but is never fresh, is a frozen link and not a silent one.
constexpr bus::Utime kStillTalking = bus::kSecond;
// An uplink that is lost, but was obeyed this recently, is about to return.
constexpr bus::Utime kObeysAgain = bus::kSecond;
// A navigation filter that corrects itself, and wind, are no leap.
constexpr double kLeap_m = 100;
constexpr double kFasterThanItSays = 2;
// Later telemetry comes through no network that Skein can fly over; of what was held back it may all come at
// once (fleet-simulator lets a link hold it back for a minute).
constexpr bus::Utime kLatest = 2 * bus::kSecond;
constexpr bus::Utime kLongestDelay = 60 * bus::kSecond;
constexpr bus::Utime kTellAgain = 10 * bus::kSecond;

double Way_m(const Telemetry& from, const Telemetry& to) {
  return std::hypot(to.state.east_m - from.state.east_m, to.state.north_m - from.state.north_m,
                    to.state.up_m - from.state.up_m);
}

}  // namespace

WatchedUav::WatchedUav(int id, std::string callsign, bool in_roster, bus::Utime now, const LinkTimes& times)
    : id_(id), callsign_(std::move(callsign)), in_roster_(in_roster), watch_(now, times) {}

void WatchedUav::Enrol(const std::string& callsign) {
  callsign_ = callsign;
  in_roster_ = true;
}

WatchedUav::Heard WatchedUav::Hear(bus::Utime now, const Telemetry& telemetry) {
  watch_.Hear(now, telemetry);
  const bus::Utime elapsed = now - heard_.value_or(now);
  heard_ = now;
  const std::optional<Telemetry> before = std::exchange(last_, telemetry);
  if (!before) return {};
  const auto is_news = [now](bus::Utime& told) {
    if (told != 0 && now - told < kTellAgain) return false;
    told = now;
    return true;
  };
  if (TimeHasJumped(elapsed, *before, telemetry)) {
    if (!is_news(jump_told_)) return {false, std::nullopt};
    return {false, Tell(event_t::ADVISORY, "time_jumped",
                        fmt::format("the clock of {} has jumped by {:.0f} s, or somebody else sends as {}",
                                    callsign_, bus::ToSeconds(telemetry.utime - before->utime - elapsed),
                                    callsign_))};
  }
  if (HasLeapt(*before, telemetry)) {
    if (!is_news(leap_told_)) return {false, std::nullopt};
    return {false, TellLeap(*before, telemetry)};
  }
  return {};
}

bool WatchedUav::TimeHasJumped(bus::Utime elapsed, const Telemetry& before, const Telemetry& after) {
  const bus::Utime by = after.utime - before.utime;
  return by < -kLatest || by > elapsed + kLongestDelay;
}

bool WatchedUav::HasLeapt(const Telemetry& before, const Telemetry& after) {
  if (after.utime < before.utime) return false;
  const double speed_m_s = std::max(before.state.speed_m_s, after.state.speed_m_s);
  const double dt_s = bus::ToSeconds(after.utime - before.utime);
  return Way_m(before, after) > kLeap_m + kFasterThanItSays * speed_m_s * dt_s;
}

Notice WatchedUav::TellLeap(const Telemetry& before, const Telemetry& after) const {
  return Tell(
      event_t::CAUTION, "position_leapt",
      fmt::format("{} is {:.0f} m from where it was {:.2f} s before: its navigation may be wrong, or "
                  "somebody else sends as {}",
                  callsign_, Way_m(before, after), bus::ToSeconds(after.utime - before.utime), callsign_));
}

Notice WatchedUav::Tell(std::int8_t severity, std::string code, std::string text) const {
  return {severity, std::move(code), std::move(text), id_, 0};
}

std::string WatchedUav::DownlinkFault(bus::Utime now) const {
  if (!heard_ && !watch_.downlink_age_us(now)) return "never heard";
  const double age_s = bus::ToSeconds(watch_.downlink_age_us(now).value_or(watch_.last_age_us(now)));
  if (heard_ && now - *heard_ < kStillTalking)
    return fmt::format("downlink repeats its state of {:.1f} s ago", age_s);
  return fmt::format("nothing heard for {:.1f} s", age_s);
}

std::string WatchedUav::UplinkFault() const {
  return fmt::format("commands not obeyed for {:.1f} s", bus::ToSeconds(watch_.uplink_age_us().value_or(0)));
}

std::vector<Notice> WatchedUav::Fault(bus::Utime now) const {
  for (const LinkState bad : {LinkState::kLost, LinkState::kLate}) {
    if (downlink_ != bad && uplink_ != bad) continue;
    const bool lost = bad == LinkState::kLost;
    const bool down = downlink_ == bad;
    return {Tell(lost ? event_t::WARNING : event_t::INFO, lost ? "link_lost" : "link_late",
                 fmt::format("{} of {} {}: {}", down ? "link" : "uplink", callsign_, lost ? "lost" : "late",
                             down ? DownlinkFault(now) : UplinkFault()))};
  }
  return {};
}

WatchedUav::Judgement WatchedUav::Judge(bus::Utime now) {
  const LinkState downlink_before = std::exchange(downlink_, (watch_.Check(now), watch_.downlink()));
  const LinkState uplink_before = std::exchange(uplink_, watch_.uplink());
  const auto became = [&](LinkState state, bool down) {
    return down ? downlink_ == state && downlink_before != state : uplink_ == state && uplink_before != state;
  };

  Judgement judgement;
  judgement.changed = downlink_ != downlink_before || uplink_ != uplink_before;
  if (!judgement.changed) return judgement;

  const bus::Utime uplink_age = watch_.uplink_age_us().value_or(0);

  if (became(LinkState::kLost, true)) {
    if (!bad_since_) bad_since_ = now - watch_.downlink_age_us(now).value_or(0);
    judgement.notices = Fault(now);
  } else if (became(LinkState::kLost, false) && downlink_ != LinkState::kLost) {
    if (!bad_since_) bad_since_ = now - uplink_age;
    judgement.notices = Fault(now);
  } else if (downlink_before == LinkState::kLost && uplink_ == LinkState::kLost && uplink_age > kObeysAgain &&
             downlink_ != LinkState::kLost) {
    judgement.notices.push_back(
        Tell(event_t::WARNING, "link_lost",
             fmt::format("downlink of {} is back, but not its uplink: {}", callsign_, UplinkFault())));
  } else if (bad_since_ && !watch_.lost()) {
    judgement.notices.push_back(Tell(
        event_t::INFO, "link_restored",
        fmt::format("link of {} restored after {:.1f} s", callsign_, bus::ToSeconds(now - *bad_since_))));
    bad_since_.reset();
  } else if (!watch_.lost() && (became(LinkState::kLate, true) ||
                                (became(LinkState::kLate, false) && downlink_ == LinkState::kUp))) {
    judgement.notices = Fault(now);
  }
  judgement.alarm = LinkAlarm(judgement.notices);
  return judgement;
}

std::string WatchedUav::alarm_key() const { return fmt::format("link:{}", id_); }

std::optional<AlarmCondition> WatchedUav::LinkAlarm(const std::vector<Notice>& notices) const {
  const bool late = downlink_ == LinkState::kLate || uplink_ == LinkState::kLate;
  if (!watch_.lost() && !late) return std::nullopt;
  AlarmCondition alarm{alarm_key(), watch_.lost() ? AlertLevel::kWarning : AlertLevel::kCaution,
                       fmt::format("link of {} {}", callsign_, watch_.lost() ? "lost" : "late"), id_};
  for (const Notice& notice : notices) {
    if (notice.code == (watch_.lost() ? "link_lost" : "link_late")) alarm.text = notice.text;
  }
  return alarm;
}

std::optional<Estimate> WatchedUav::Locate(bus::Utime now, const UncertaintyGrowth& growth) const {
  if (!watch_.last()) return std::nullopt;
  const double age_s = bus::ToSeconds(watch_.last_age_us(now));
  const bool silent = watch_.downlink() != LinkState::kUp;
  return DeadReckon(watch_.last()->state, age_s, silent ? age_s : 0, growth);
}

}  // namespace skein::monitor

#include "core/link_watch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace skein {
namespace {

constexpr double kJudgedSpeed = 2;     // [m/s] below which standing still is no fault
constexpr double kLeastShare = 0.5;    // of the way that the speed promises
constexpr double kLongestPromise = 1;  // [s] after longer silence the UAV may have flown a circle
constexpr int kRisingStampsOfNewClock = 3;

bool MovedAsItMust(const Telemetry& before, const Telemetry& after) {
  if (after.state.speed_m_s < kJudgedSpeed) return true;
  const double elapsed_s = static_cast<double>(after.utime - before.utime) * 1e-6;
  const double way_m =
      std::hypot(after.state.east_m - before.state.east_m, after.state.north_m - before.state.north_m,
                 after.state.up_m - before.state.up_m);
  return way_m >= kLeastShare * after.state.speed_m_s * std::min(elapsed_s, kLongestPromise);
}

}  // namespace

void Check(const LinkTimes& times) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(times.late_us > 0, "late_us: must be above 0");
  require(times.lost_us > times.late_us, "lost_us: must be above late_us");
  require(times.unknown_us > 0, "unknown_us: must be above 0");
  require(times.return_us > 0, "return_us: must be above 0");
  require(times.listen_us > 0 && times.listen_us < times.lost_us,
          "listen_us: must be above 0, below lost_us");
}

LinkDirection::LinkDirection(const LinkTimes& times) : times_(times) { skein::Check(times_); }

void LinkDirection::Prove(std::int64_t now) {
  if (!last_proof_ || now - *last_proof_ >= times_.late_us) run_start_ = now;
  last_proof_ = now;
  if (state_ != LinkState::kLost || now - run_start_ >= times_.return_us) state_ = LinkState::kUp;
}

void LinkDirection::Check(std::int64_t age_us) {
  switch (state_) {
    case LinkState::kUnknown:
      if (age_us >= (recalled_ ? times_.lost_us : times_.unknown_us)) state_ = LinkState::kLost;
      break;
    case LinkState::kUp:
    case LinkState::kLate:
      if (age_us >= times_.late_us) state_ = age_us >= times_.lost_us ? LinkState::kLost : LinkState::kLate;
      break;
    case LinkState::kLost:
      break;
  }
}

void LinkDirection::Forget() {
  recalled_ = false;
  if (state_ != LinkState::kLost) state_ = LinkState::kUnknown;
}

LinkWatch::LinkWatch(std::int64_t now, const LinkTimes& times)
    : times_(times), since_(now), downlink_(times), uplink_(times) {}

LinkWatch::Heard LinkWatch::Hear(std::int64_t now, const Telemetry& telemetry) {
  if (!newest_) {
    newest_ = last_ = telemetry;
    last_arrival_ = now;
    return Heard::kStale;
  }
  if (telemetry.utime <= newest_->utime) {
    if (!ClockJumped(telemetry)) return Heard::kStale;
    newest_ = last_ = telemetry;
    last_arrival_ = now;
    return Heard::kClockJumped;
  }
  old_stamp_.reset();
  HearObedience(now, telemetry);
  const bool fresh = MovedAsItMust(*newest_, telemetry);
  newest_ = telemetry;
  if (!fresh) return Heard::kStale;
  last_ = telemetry;
  last_arrival_ = now;
  fresh_at_ = now;
  downlink_.Prove(now);
  return Heard::kFresh;
}

bool LinkWatch::ClockJumped(const Telemetry& telemetry) {
  // A little older is what jitter does to the order of arrival.
  if (newest_->utime - telemetry.utime <= times_.late_us) return false;
  old_stamps_rising_ = old_stamp_ && telemetry.utime > *old_stamp_ ? old_stamps_rising_ + 1 : 1;
  old_stamp_ = telemetry.utime;
  if (old_stamps_rising_ < kRisingStampsOfNewClock) return false;
  old_stamp_.reset();
  return true;
}

void LinkWatch::HearObedience(std::int64_t now, const Telemetry& telemetry) {
  if (session_id_ == 0 || telemetry.command_session_id != session_id_) return;
  if (newest_->command_session_id == session_id_ && telemetry.command_sequence <= newest_->command_sequence)
    return;
  unobeyed_since_.reset();
  uplink_.Prove(now);
}

void LinkWatch::Command(std::int64_t now, std::int64_t session_id) {
  // A later one may be a false one that was heard once: silent, it stands in nobody's way.
  if (session_id < session_id_ && now - last_command_ < times_.lost_us) return;
  // After a pause, or from a new controller, the UAV is given its time anew.
  if (!unobeyed_since_ || session_id != session_id_ || now - last_command_ >= times_.late_us)
    unobeyed_since_ = now;
  session_id_ = session_id;
  last_command_ = now;
}

void LinkWatch::Check(std::int64_t now) {
  downlink_.Check(now - (downlink() == LinkState::kUnknown ? since_ : fresh_at_.value_or(since_)));
  if (now - last_command_ >= times_.lost_us) uplink_.Forget();
  uplink_.Check(Disobeyed());
}

std::optional<LinkWatch::Memory> LinkWatch::Remember(std::int64_t now) const {
  if (!fresh_at_) return std::nullopt;
  return Memory{*fresh_at_, session_id_, unobeyed_since_.value_or(now)};
}

void LinkWatch::Recall(std::int64_t now, const Memory& memory) {
  const std::int64_t earliest = now + times_.listen_us - times_.lost_us;
  fresh_at_ = memory.fresh_at;
  since_ = std::max(memory.fresh_at, earliest);
  downlink_.Recall();
  if (memory.session_id == 0) return;
  session_id_ = memory.session_id;
  unobeyed_since_ = std::max(memory.unobeyed_since, earliest);
  last_command_ = now;
  uplink_.Recall();
}

std::optional<std::int64_t> LinkWatch::downlink_age_us(std::int64_t now) const {
  if (!fresh_at_) return std::nullopt;
  return now - *fresh_at_;
}

std::int64_t LinkWatch::Disobeyed() const { return unobeyed_since_ ? last_command_ - *unobeyed_since_ : 0; }

std::optional<std::int64_t> LinkWatch::uplink_age_us() const {
  if (uplink() == LinkState::kUnknown) return std::nullopt;
  return Disobeyed();
}

std::int64_t LinkWatch::last_age_us(std::int64_t now) const {
  if (!last_) return 0;
  const std::int64_t by_arrival = now - last_arrival_;
  const std::int64_t by_stamp = now - last_->utime;
  return by_stamp < by_arrival || by_stamp > by_arrival + times_.lost_us ? by_arrival : by_stamp;
}

}  // namespace skein

#include "bus/chunk_order.h"

namespace skein::bus {
namespace {

// A source that was silent for longer has been halted or set: it must show three stamps.
constexpr Utime kLongestPause = 10 * kSecond;
constexpr int kStampsNeeded = 3;
// No network that Skein can fly over brings anything later.
constexpr Utime kLatest = 2 * kSecond;

}  // namespace

bool SetOrder::FitsCurrent(const SetStamp& stamp) const {
  return stamp.session_id == current_.session_id && stamp.set > current_.set &&
         stamp.utime >= current_.utime && stamp.utime - current_.utime <= kLongestPause;
}

bool SetOrder::ThirdInARow(const SetStamp& stamp) {
  if (candidate_stamps_ > 0 && stamp == candidate_) return false;  // another chunk of the same set
  const bool rises = candidate_stamps_ > 0 && stamp.session_id == candidate_.session_id &&
                     stamp.set > candidate_.set && stamp.utime > candidate_.utime &&
                     stamp.utime - candidate_.utime <= kLongestPause;
  candidate_stamps_ = rises ? candidate_stamps_ + 1 : 1;
  candidate_ = stamp;
  return candidate_stamps_ >= kStampsNeeded;
}

bool SetOrder::StartsAnew(const SetStamp& stamp) const {
  return stamp.session_id == current_.session_id && stamp.set == 0 && current_.set > 0 &&
         stamp.utime > current_.utime;
}

bool SetOrder::IsLate(const SetStamp& stamp) const {
  const Utime most = stamp.session_id == current_.session_id ? kLongestPause : 0;
  return stamp.utime >= current_.utime - kLatest && stamp.utime <= current_.utime + most;
}

SetOrder::Verdict SetOrder::Judge(const SetStamp& stamp) {
  Verdict verdict = Verdict::kFalse;
  if (started_ && stamp == current_) {
    verdict = Verdict::kSame;
  } else if (!started_ || stamp.session_id > current_.session_id || StartsAnew(stamp)) {
    verdict = Verdict::kNewSource;
  } else if (FitsCurrent(stamp)) {
    verdict = Verdict::kNext;
  } else if (ThirdInARow(stamp)) {
    verdict = Verdict::kTakenAgain;
  } else {
    return IsLate(stamp) ? Verdict::kLate : Verdict::kFalse;
  }
  started_ = true;
  current_ = stamp;
  candidate_stamps_ = 0;
  return verdict;
}

}  // namespace skein::bus

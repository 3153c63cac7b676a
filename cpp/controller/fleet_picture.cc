#include "controller/fleet_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skein::controller {

void VehicleView::Take(const VehicleState& heard, bus::Utime stamp, bus::Utime tick_utime) {
  constexpr bus::Utime kFarOff = 2 * bus::kSecond;  // older ones than this are no mere jitter
  const bool newer = !stamp_ || stamp > *stamp_;
  if (!newer || stamp > tick_utime + kFarOff) {
    if (!newer && stamp > *stamp_ - kFarOff) return;
    odd_stamps_ = stamp > odd_stamp_ ? odd_stamps_ + 1 : 1;
    odd_stamp_ = stamp;
    if (odd_stamps_ < 3) return;
  }
  odd_stamps_ = 0;
  stamp_ = stamp;
  state = heard;
  state_utime = std::min(stamp, tick_utime);
  fresh = true;
}

void VehicleView::TakeClock(bus::Utime tick_utime) {
  state_utime = tick_utime;
  stamp_.reset();
  odd_stamps_ = 0;
}

VehicleState VehicleView::At(bus::Utime utime) const {
  assert(state);
  VehicleState moved = *state;
  if (utime == state_utime) return moved;  // as most are at a tick
  const double seconds = bus::ToSeconds(utime - state_utime);
  // Without commands a UAV levels off after a second, through its own autopilot's lag: eq. (1) with mu_c = 0.
  // From a climb at 10 m/s that is another 110 m, more than a cylinder is high.
  constexpr double kHoldsAfter = 1;
  const double k = model.gains.climb_per_s;
  const double climbing = std::min(seconds, kHoldsAfter);
  const double way = moved.speed_m_s * (climbing * std::cos(moved.climb_rad) + (seconds - climbing));
  moved.east_m += way * std::cos(moved.course_rad);
  moved.north_m += way * std::sin(moved.course_rad);
  const double levelling = (1 - std::exp(-k * std::max(0.0, seconds - kHoldsAfter))) / k;
  moved.up_m += moved.speed_m_s * std::sin(moved.climb_rad) * (climbing + levelling);
  return moved;
}

}  // namespace skein::controller

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
  const double seconds = bus::ToSeconds(utime - state_utime);
  const double way = moved.speed_m_s * std::cos(moved.climb_rad) * seconds;
  moved.east_m += way * std::cos(moved.course_rad);
  moved.north_m += way * std::sin(moved.course_rad);
  // A UAV that is not heard levels off within seconds, so its last climb is carried on for no longer than
  // that.
  constexpr double kLevelsOffAfter = 2;
  moved.up_m += moved.speed_m_s * std::sin(moved.climb_rad) * std::min(seconds, kLevelsOffAfter);
  return moved;
}

}  // namespace skein::controller

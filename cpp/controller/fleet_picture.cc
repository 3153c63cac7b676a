#include "controller/fleet_picture.h"

#include <cassert>
#include <cmath>

namespace skein::controller {

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

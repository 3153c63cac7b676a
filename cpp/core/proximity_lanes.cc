#include "core/proximity_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/processors.h"

namespace skein {
namespace {

constexpr double kNobody = std::numeric_limits<double>::infinity();

/// Eq. (3) of [1], without a branch: all of it is worked out, and then what holds is taken.
[[gnu::always_inline]] inline double TauOf(double range_m, double closing_m_s, TauLimits limits) {
  const double outside =
      (range_m - limits.d_mod_m * limits.d_mod_m / range_m) / std::max(closing_m_s, limits.min_closing_m_s);
  return range_m <= limits.d_mod_m ? 0 : outside;
}

}  // namespace

SKEIN_FOR_EACH_PROCESSOR
void LookAt(const EightUavs& uavs, const Looker& looker, Looks& looks) {
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = uavs.position[0][i] - looker.position[0];
    const double y = uavs.position[1][i] - looker.position[1];
    const double z = uavs.position[2][i] - looker.position[2];
    const double u = uavs.velocity[0][i] - looker.velocity[0];
    const double v = uavs.velocity[1][i] - looker.velocity[1];
    const double w = uavs.velocity[2][i] - looker.velocity[2];
    const double range_m = std::sqrt(x * x + y * y + z * z);
    const double closing_m_s = -(x * u + y * v + z * w) / range_m;
    const bool ours = uavs.group[i] == looker.group && looker.group > 0;
    const TauLimits limits{ours ? looker.own.d_mod_m : looker.others.d_mod_m,
                           ours ? looker.own.min_closing_m_s : looker.others.min_closing_m_s};
    const double tau_s = TauOf(range_m, closing_m_s, limits);
    const double closing_tau_s = closing_m_s > 0 ? tau_s : kNobody;
    looks.range_m[i] = range_m;
    looks.tau_s[i] = range_m == 0 ? 0 : closing_tau_s;
  }
}

SKEIN_FOR_EACH_PROCESSOR
void LookAt(const EightBoxes& boxes, const Looker& looker, Looks& looks) {
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < kLanes; ++i) {
    double gap[3];
    double product[3];
    double speed_squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = boxes.low[axis][i] - looker.position[axis];
      const double high = boxes.high[axis][i] - looker.position[axis];
      const double low_speed = boxes.velocity_low[axis][i] - looker.velocity[axis];
      const double high_speed = boxes.velocity_high[axis][i] - looker.velocity[axis];
      gap[axis] = std::max(std::max(low, -high), 0.0);
      // Interval arithmetic: the least that r . w can be on this axis.
      product[axis] = std::min(std::min(low * low_speed, low * high_speed),
                               std::min(high * low_speed, high * high_speed));
      speed_squared += std::max(low_speed * low_speed, high_speed * high_speed);
    }
    const double range_m = std::sqrt(gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]);
    const double closest = -(product[0] + product[1] + product[2]);
    // Nobody closes faster than the relative speed either; rounding may break that law by a hair.
    constexpr double kHair = 1 + 1e-12;
    const double closing_m_s = std::min(closest / range_m, std::sqrt(speed_squared) * kHair);
    const bool ours = boxes.group[i] == looker.group && looker.group > 0;
    const bool strangers = boxes.group[i] >= 0 && !ours;
    const TauLimits limits{
        ours ? looker.own.d_mod_m : (strangers ? looker.others.d_mod_m : looker.widest.d_mod_m),
        ours ? looker.own.min_closing_m_s
             : (strangers ? looker.others.min_closing_m_s : looker.widest.min_closing_m_s)};
    const double tau_s = TauOf(range_m, closing_m_s, limits);
    const double closing_tau_s = closest > 0 ? tau_s : kNobody;
    looks.range_m[i] = range_m;
    looks.tau_s[i] = range_m == 0 ? 0 : closing_tau_s;
  }
}

}  // namespace skein

#include "core/proximity_lanes.h"

#include <algorithm>

#include "core/processors.h"

namespace skein {
namespace {

/// More than rounding can take away from any of the numbers compared here.
constexpr double kHair = 1e-12;

/// Eq. (3) of [1] says for d > D_mod that Tau <= T where d^2 - D_mod^2 <= T max(-d' d, V_min d), and -d' d is
/// -(r . w). Of a box the least d and the largest -(r . w) and |w| are known, so that two bounds of -d' d
/// hold: -(r . w), and |w| d. All squared where a root would be needed, and 0 or 1 without a branch.
[[gnu::always_inline]] inline std::int64_t Reaches(double range_m2, double closing_product, double speed_m2,
                                                   const PairReach& reach) {
  const double outside_m2 = range_m2 * (1 - kHair) - reach.d_mod_m2;
  const double in_time_m2 = reach.tau_s * (1 + kHair);
  const double outside_m4 = outside_m2 * outside_m2;
  const double in_time_m4 = in_time_m2 * in_time_m2 * range_m2;
  const std::int64_t near = range_m2 <= reach.range_m2 * (1 + kHair);
  const std::int64_t within = outside_m2 <= 0;
  const std::int64_t in_time = outside_m2 <= in_time_m2 * closing_product;
  const std::int64_t in_reach = outside_m4 <= in_time_m4 * speed_m2 * (1 + kHair);
  const std::int64_t slow = outside_m4 <= in_time_m4 * reach.min_closing_m2 * (1 + kHair);
  const std::int64_t closing = closing_product > 0;
  return near | (closing & (within | (in_time & in_reach) | slow));
}

}  // namespace

SKEIN_FOR_EACH_PROCESSOR
bool MayMatter(const EightLookers& lookers, const EightBoxes& boxes, std::size_t box, Marks& to) {
  const EightUavs& uavs = *lookers.uavs;
  const Reach& own = lookers.own;
  const Reach& others = lookers.others;
  const double group = boxes.group[box];
  const std::int64_t has_group = group > 0;
  const std::int64_t several = group == kSeveralGroups;
  std::int64_t any = 0;
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < kLanes; ++i) {
    double range_m2 = 0;
    double least_product = 0;
    double speed_m2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = boxes.low[axis][box] - uavs.position[axis][i];
      const double high = boxes.high[axis][box] - uavs.position[axis][i];
      const double low_speed = boxes.velocity_low[axis][box] - uavs.velocity[axis][i];
      const double high_speed = boxes.velocity_high[axis][box] - uavs.velocity[axis][i];
      const double gap = std::max(std::max(low, -high), 0.0);
      range_m2 += gap * gap;
      // Interval arithmetic: the least that r . w can be on this axis.
      least_product += std::min(std::min(low * low_speed, low * high_speed),
                                std::min(high * low_speed, high * high_speed));
      speed_m2 += std::max(low_speed * low_speed, high_speed * high_speed);
    }
    const std::int64_t ours = group == uavs.group[i] ? has_group : 0;
    const std::int64_t to_own = (ours | several) & Reaches(range_m2, -least_product, speed_m2, own.Of(i));
    const std::int64_t to_others = (1 - ours) & Reaches(range_m2, -least_product, speed_m2, others.Of(i));
    to[i] = to_own | to_others;
    any |= to[i];
  }
  return any != 0;
}

SKEIN_FOR_EACH_PROCESSOR
bool MayMatter(const EightLookers& lookers, std::size_t looker, const EightUavs& uavs, Marks& who) {
  const EightUavs& from = *lookers.uavs;
  const double x = from.position[0][looker], y = from.position[1][looker], z = from.position[2][looker];
  const double u = from.velocity[0][looker], v = from.velocity[1][looker], w = from.velocity[2][looker];
  const double group = from.group[looker];
  const std::int64_t has_group = group > 0;
  const PairReach own = lookers.own.Of(looker);
  const PairReach others = lookers.others.Of(looker);
  std::int64_t any = 0;
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double rx = uavs.position[0][i] - x;
    const double ry = uavs.position[1][i] - y;
    const double rz = uavs.position[2][i] - z;
    const double wx = uavs.velocity[0][i] - u;
    const double wy = uavs.velocity[1][i] - v;
    const double wz = uavs.velocity[2][i] - w;
    const double range_m2 = rx * rx + ry * ry + rz * rz;
    const double closing_product = -(rx * wx + ry * wy + rz * wz);
    const double speed_m2 = wx * wx + wy * wy + wz * wz;
    const std::int64_t ours = uavs.group[i] == group ? has_group : 0;
    who[i] = (ours & Reaches(range_m2, closing_product, speed_m2, own)) |
             ((1 - ours) & Reaches(range_m2, closing_product, speed_m2, others));
    any |= who[i];
  }
  return any != 0;
}

SKEIN_FOR_EACH_PROCESSOR
void Gaps(const EightBoxes& from, std::size_t box, const EightBoxes& to, Lanes& square_m2) {
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < kLanes; ++i) {
    double sum_m2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double above = to.low[axis][i] - from.high[axis][box];
      const double below = from.low[axis][box] - to.high[axis][i];
      const double gap = std::max(std::max(above, below), 0.0);
      sum_m2 += gap * gap;
    }
    square_m2[i] = sum_m2;
  }
}

}  // namespace skein

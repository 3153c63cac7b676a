#include "core/path_planning.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace skein {

std::string Metres(double length_m) {
  std::string digits = std::to_string(static_cast<long long>(std::ceil(length_m - 1e-6)));
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<size_t>(at), ",");
  return digits + " m";
}

LeaderMotion Widened(const LeaderMotion& one, const LeaderMotion& other) {
  return {std::min(one.min_speed_m_s, other.min_speed_m_s), std::max(one.max_speed_m_s, other.max_speed_m_s),
          std::max(one.acceleration_m_s2, other.acceleration_m_s2)};
}

bool Covers(const LeaderMotion& outer, const LeaderMotion& inner) {
  constexpr double kRounding = 1e-6;
  return inner.min_speed_m_s >= outer.min_speed_m_s - kRounding &&
         inner.max_speed_m_s <= outer.max_speed_m_s + kRounding &&
         inner.acceleration_m_s2 <= outer.acceleration_m_s2 + kRounding;
}

TurnResult PlanTurn(const TurnRequest& request, const LeaderMotion& motion, const PathLimits& limits,
                    double comfort) {
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(1);
  const auto least = LeastRadius(limits, motion, request.turn_rad);
  if (!least) {
    reason << "at " << motion.min_speed_m_s << " to " << motion.max_speed_m_s
           << " m/s no turn is possible, the slots can fly " << limits.min_speed_m_s << " to "
           << limits.max_speed_m_s << " m/s";
    return {{}, reason.str()};
  }
  if (request.radius_m > 0 && request.radius_m < *least) {
    return {{},
            "a turn radius of " + Metres(request.radius_m) + " is too tight for the slots, the least is " +
                Metres(*least)};
  }
  const double radius =
      request.radius_m > 0 ? request.radius_m : *least * (1 + comfort * (kComfortRadius - 1));
  const auto slope = MostSlope(limits, motion, 1 / radius);
  if (!slope) return {{}, "speed or altitude changes too fast while the formation turns"};
  if (request.ramp_s == 0) return {MakeTurn(request.turn_rad, 1 / radius, *slope), ""};

  const double least_s = 1 / (radius * *slope * motion.max_speed_m_s);
  if (request.ramp_s < least_s * (1 - 1e-9)) {
    reason << "a curvature ramp of " << request.ramp_s << " s is too short for the slots, the least is "
           << least_s << " s";
    return {{}, reason.str()};
  }
  return {MakeTurn(request.turn_rad, 1 / radius, 1 / (radius * request.ramp_s * motion.max_speed_m_s)), ""};
}

}  // namespace skein

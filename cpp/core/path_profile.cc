#include "core/path_profile.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// A climb on its own may use this much of the acceleration limit; curvature ramps on the way need the rest.
constexpr double kClimbAcceleration = 0.5;

/// Marks closer together than this are one.
constexpr double kSameArc_m = 1e-6;

/// Levelling off uses this much of the limit of climb-angle rate: slots on the inside of a turn climb
/// steeper.
constexpr double kSettleShare = 0.4;
constexpr double kSettle_s = 3;  ///< at least, for speed always

}  // namespace

Jet Quintic(const Jet& start, const Jet& end, double length_m, double along_m) {
  const double rise = end.value - start.value;
  const double v0 = start.slope * length_m, v1 = end.slope * length_m;
  const double a0 = start.rate * length_m * length_m, a1 = end.rate * length_m * length_m;
  const double c3 = 10 * rise - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15 * rise + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
  const double c5 = 6 * rise - 3 * (v0 + v1) - 0.5 * (a0 - a1);
  const double u = along_m / length_m;
  return {start.value + u * (v0 + u * (0.5 * a0 + u * (c3 + u * (c4 + u * c5)))),
          (v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / length_m,
          (a0 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (length_m * length_m)};
}

Jet UpOf(const ProfileKnot& knot) { return {knot.up_m, knot.up_slope, knot.up_slope_rate_per_m}; }

Jet SpeedOf(const ProfileKnot& knot) {
  return {knot.speed_m_s, knot.speed_slope_per_s, knot.speed_slope_rate_per_m_s};
}

Jet UpOf(const PathPoint& point) { return {point.up_m, point.up_slope, point.up_slope_rate_per_m}; }

Jet SpeedOf(const PathPoint& point) {
  return {point.speed_m_s, point.speed_slope_per_s, point.speed_slope_rate_per_m_s};
}

ProfileKnot MakeKnot(double arc_m, const Jet& up, const Jet& speed) {
  return {arc_m, up.value, speed.value, up.slope, up.rate, speed.slope, speed.rate};
}

Jet Through(const std::vector<Mark>& marks, double arc_m) {
  const auto after = std::upper_bound(marks.begin(), marks.end(), arc_m,
                                      [](double arc, const Mark& mark) { return arc < mark.arc_m; });
  if (after == marks.begin()) return {marks.front().jet.value};
  const Mark& before = *(after - 1);
  if (after == marks.end()) return arc_m - before.arc_m < kSameArc_m ? before.jet : Jet{before.jet.value};
  return Quintic(before.jet, after->jet, after->arc_m - before.arc_m, arc_m - before.arc_m);
}

void Add(std::vector<Mark>& marks, double arc_m, const Jet& jet) {
  if (marks.empty() || arc_m - marks.back().arc_m >= kSameArc_m) marks.push_back({arc_m, jet});
}

std::vector<ProfileKnot> Merge(const std::vector<Mark>& up, const std::vector<Mark>& speed, double from_m,
                               double to_m) {
  std::vector<double> arcs{from_m, to_m};
  for (const std::vector<Mark>* marks : {&up, &speed}) {
    for (const Mark& mark : *marks) {
      if (mark.arc_m > from_m + kSameArc_m && mark.arc_m < to_m - kSameArc_m) arcs.push_back(mark.arc_m);
    }
  }
  std::sort(arcs.begin(), arcs.end());
  std::vector<ProfileKnot> knots;
  for (const double arc : arcs) {
    if (!knots.empty() && arc - knots.back().arc_m < kSameArc_m) continue;
    knots.push_back(MakeKnot(arc, Through(up, arc), Through(speed, arc)));
  }
  return knots;
}

double SettleRise(const Jet& start, double length_m) {
  return length_m * (start.slope / 2 + start.rate * length_m / 12);
}

double ClimbSettleLength(const Jet& up, double speed_m_s, const PathLimits& limits) {
  if (up.slope == 0 && up.rate == 0) return 0;
  // The slope falls like a cubic, at most 1.5 times as fast as evenly.
  const double for_rate = 1.5 * (std::abs(up.slope) + std::abs(up.rate) * speed_m_s) * speed_m_s /
                          (kSettleShare * limits.max_climb_rate_rad_s);
  return std::max(for_rate, kSettle_s * speed_m_s);
}

double SpeedSettleLength(const Jet& speed) {
  return speed.slope == 0 && speed.rate == 0 ? 0 : kSettle_s * speed.value;
}

double ClimbLength(double height_m, double speed_m_s, const PathLimits& limits) {
  const double height = std::abs(height_m);
  const double for_angle = kQuinticSlope * height / std::tan(limits.max_climb_rad);
  const double for_rate = std::sqrt(kQuinticRate * height * speed_m_s / limits.max_climb_rate_rad_s);
  const double for_acceleration = std::cbrt(kQuinticProduct * height * height * speed_m_s * speed_m_s /
                                            (kClimbAcceleration * limits.max_acceleration_m_s2));
  return std::max({for_angle, for_rate, for_acceleration});
}

double SpeedChangeLength(double from_m_s, double to_m_s, double share, const PathLimits& limits) {
  return kQuinticSlope * std::abs(to_m_s - from_m_s) * std::max(from_m_s, to_m_s) /
         (share * limits.max_acceleration_m_s2);
}

}  // namespace skein

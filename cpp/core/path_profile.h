#pragma once

#include <vector>

#include "core/path.h"

namespace skein {

/// A quantity with its first two derivatives over arc length.
struct Jet {
  double value = 0;
  double slope = 0;
  double rate = 0;
};

/// The quintic from `start` to `end` over length_m > 0, at along_m.
Jet Quintic(const Jet& start, const Jet& end, double length_m, double along_m);

/// Greatest slope and slope rate of the quintic with level ends that rises by 1 over a length of 1, and the
/// greatest product of the two at one place.
constexpr double kQuinticSlope = 1.875;
constexpr double kQuinticRate = 5.7735;
constexpr double kQuinticProduct = 6.695;

Jet UpOf(const ProfileKnot& knot);
Jet SpeedOf(const ProfileKnot& knot);
Jet UpOf(const PathPoint& point);
Jet SpeedOf(const PathPoint& point);
ProfileKnot MakeKnot(double arc_m, const Jet& up, const Jet& speed);

/// A knot of one quantity.
struct Mark {
  double arc_m = 0;
  Jet jet;
};

/// The quantity that runs through marks of rising arc length, at arc_m; level before the first and past the
/// last.
Jet Through(const std::vector<Mark>& marks, double arc_m);

/// A mark after the others, unless it falls on the last one (which it then equals).
void Add(std::vector<Mark>& marks, double arc_m, const Jet& jet);

/// Altitude and speed each through their own marks, as the one list of knots from from_m to to_m that gives
/// exactly both.
std::vector<ProfileKnot> Merge(const std::vector<Mark>& up, const std::vector<Mark>& speed, double from_m,
                               double to_m);

/// How a quantity levels off when its slope and slope rate fade to zero over a length: its change of value.
double SettleRise(const Jet& start, double length_m);

/// Length over which a climb levels off gently, and over which an acceleration ends.
double ClimbSettleLength(const Jet& up, double speed_m_s, const PathLimits& limits);
double SpeedSettleLength(const Jet& speed);

/// Least length of a level-ended change of altitude that keeps the climb angle, its rate and the acceleration
/// along the flight path (at a share of its limit) at up to speed_m_s.
double ClimbLength(double height_m, double speed_m_s, const PathLimits& limits);

/// Least length of a level-ended change of speed within `share` of the acceleration limit.
double SpeedChangeLength(double from_m_s, double to_m_s, double share, const PathLimits& limits);

}  // namespace skein

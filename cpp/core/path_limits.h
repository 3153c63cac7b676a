#pragma once

#include <optional>
#include <string>

#include "core/path.h"

namespace skein {

/// What the leader does while any slot is in some stretch of the path: a slot `forward_m` ahead of the leader
/// is at an arc length while the leader is forward_m short of it, and flies at the speed that the leader has
/// there.
struct LeaderMotion {
  double min_speed_m_s = 0;
  double max_speed_m_s = 0;
  double acceleration_m_s2 =
      0;  ///< the most that its speed changes and climbs ask of a slot, beside the ramps of curvature
};

/// Smallest radius that course rate and slot speeds allow in a turn (turn_rad left positive); none when no
/// turn is possible because a slot is at its least or greatest speed already.
std::optional<double> LeastRadius(const PathLimits& limits, const LeaderMotion& motion, double turn_rad);

/// Greatest change of curvature per metre up to this curvature: the outermost slot's acceleration -v^2 l
/// dkappa/ds, on top of motion.acceleration_m_s2, stays within the limit, and a ramp to the full curvature
/// takes kLeastRamp_s at least. None when the leader's own motion leaves (almost) nothing of the limit.
std::optional<double> MostSlope(const PathLimits& limits, const LeaderMotion& motion, double curvature_per_m);
constexpr double kLeastRamp_s = 3;

/// What the leader does while slots are between two arc lengths, from samples of the path.
LeaderMotion MotionWhile(const Path& path, const PathLimits& limits, double from_m, double to_m);

/// The first place between two arc lengths where a slot would leave the limits.
struct Excess {
  double arc_m = 0;
  std::string what;  ///< "the slot 500 m to the left would slow down to 21.4 m/s, the least is 33.0 m/s"
};
std::optional<Excess> FirstExcess(const Path& path, const PathLimits& limits, double from_m, double to_m);

/// The speed at which a formation loiters: this one, unless it is so near to the slots' least or greatest
/// that the circle would be huge.
double LoiterSpeed(const PathLimits& limits, double speed_m_s);

/// From head to tail, and the clearance between them when they meet on a loop.
double LeastLoop(const PathLimits& limits);

}  // namespace skein

#pragma once

#include <optional>
#include <vector>

#include "core/path.h"
#include "core/path_connect.h"
#include "core/path_limits.h"
#include "core/path_pieces.h"
#include "core/path_profile.h"
#include "core/path_section.h"

namespace skein {

/// Where and how a new path leaves the one that is flown.
struct Departure {
  const Path& current;
  double keep_from_m;  ///< what lies further back is dropped
  PathPoint start;     ///< from here on all is new: the leader's place, or the foremost slot's when that is
                       ///< ahead of it
};

Departure Depart(const Path& current, double arc_m, double keep_behind_m, const PathLimits& limits);

/// The part of a new path that is under construction, from the departure on.
struct Draft {
  explicit Draft(const Departure& departure)
      : chain({departure.start.position, departure.start.course_rad}, departure.start.arc_m),
        up{{departure.start.arc_m, UpOf(departure.start)}},
        speed{{departure.start.arc_m, SpeedOf(departure.start)}} {}

  PieceChain chain;
  std::vector<Mark> up;
  std::vector<Mark> speed;
};

/// What was flown, the draft up to the later of its pieces' and its profile's end, and then `next`, if any.
Path Assemble(const Departure& departure, const Draft& draft, double profile_end_m,
              const PathSection& next = {}, std::optional<double> loop_start_m = std::nullopt);

/// Where the leader's speed may begin to change: not before the last slot has left the curves behind the
/// departure, whose ramps leave it no acceleration to spare.
double SpeedChangeFrom(const Departure& departure, const PathLimits& limits);

/// Rate of turns of a radius, when the leader's own changes of speed and climb take `reserve` (0 to 1) of the
/// acceleration limit.
TurnRate RateOf(double radius_m, double max_speed_m_s, double reserve, const PathLimits& limits);

}  // namespace skein

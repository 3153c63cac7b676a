#pragma once

#include <optional>
#include <vector>

#include "core/path.h"

namespace skein {

/// A stretch of a path, unrolled: laps one after the other, what lies past an open end as a piece of its own.
struct PathSection {
  double start_arc_m = 0;
  std::vector<PathPiece> pieces;
  std::vector<ProfileKnot> knots;  ///< the first one at the section's start, the last one at its end
};

/// From from_m (or the path's start, when that is later) to to_m. The same curve exactly; no piece when
/// nothing lies between.
PathSection Section(const Path& path, double from_m, double to_m);

/// The first arc length at or past arc_m where the path does not curve. Near an open end without one: the
/// last before arc_m. None when the path curves everywhere.
std::optional<double> StraightPoint(const Path& path, double arc_m);

/// Whether the path curves anywhere between two arc lengths.
bool Curves(const Path& path, double from_m, double to_m);

}  // namespace skein

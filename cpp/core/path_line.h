#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/path.h"

namespace skein {

/// Points (east, north, up) along the path from one arc length to another, the chords between them at most
/// `chord_error_m` off the path.
std::vector<Eigen::Vector3d> SampleLine(const Path& path, double from_arc_m, double to_arc_m,
                                        double chord_error_m = 2);

/// The stretch of a path that is drawn.
struct DrawnStretch {
  double from_arc_m = 0;
  double to_arc_m = 0;
  bool endless = false;  ///< it goes straight on for good: drawn anew when the leader has got far along it
};

/// From 3 km behind the leader to the path's end; a closed path, or the circle that an open one ends in, once
/// round; 20 km of a path that ends in a straight line.
DrawnStretch StretchToDraw(const Path& path, double leader_arc_m, bool straight_on);

}  // namespace skein

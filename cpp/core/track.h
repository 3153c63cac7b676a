#pragma once

#include <Eigen/Core>
#include <vector>

namespace skein {

/// Where a UAV is at a time.
struct TrackPoint {
  double t_s = 0;
  Eigen::Vector3d position{0, 0, 0};  ///< ENU [m]
};

/// A UAV's way through space and time.
struct Track {
  int vehicle_id = 0;
  std::vector<TrackPoint> points;  ///< in order of time
};

/// Without the points near which a UAV is anyway that flies evenly from one of the rest to the next: at no
/// point's time is it farther than `tolerance_m` from there. The first and the last one stay.
std::vector<TrackPoint> Thinned(const std::vector<TrackPoint>& points, double tolerance_m);

/// All of them thinned to within 2 m, or as much more as it takes to have at most `most_points` in all.
std::vector<Track> Thinned(std::vector<Track> tracks, std::size_t most_points);

}  // namespace skein

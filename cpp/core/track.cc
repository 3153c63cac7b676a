#include "core/track.h"

#include <utility>

namespace skein {

std::vector<TrackPoint> Thinned(const std::vector<TrackPoint>& points, double tolerance_m) {
  if (points.size() < 3) return points;
  // As Douglas and Peucker do it, but with the distance at the same time instead of that to the line: where a
  // UAV is slow, the line alone would not tell.
  std::vector<bool> stays(points.size(), false);
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, points.size() - 1}};
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    const TrackPoint& from = points[first];
    const TrackPoint& to = points[last];
    double farthest_m = tolerance_m;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double share = (points[i].t_s - from.t_s) / (to.t_s - from.t_s);
      const Eigen::Vector3d there = from.position + share * (to.position - from.position);
      const double off_m = (points[i].position - there).norm();
      if (off_m <= farthest_m) continue;
      farthest_m = off_m;
      farthest = i;
    }
    if (farthest == first) continue;
    stays[farthest] = true;
    stretches.emplace_back(first, farthest);
    stretches.emplace_back(farthest, last);
  }
  std::vector<TrackPoint> thinned;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (stays[i]) thinned.push_back(points[i]);
  }
  return thinned;
}

std::vector<Track> Thinned(std::vector<Track> tracks, std::size_t most_points) {
  constexpr double kTolerance_m = 2;
  constexpr double kCoarsest_m = 1e6;
  for (double tolerance_m = kTolerance_m;; tolerance_m *= 2) {
    std::size_t points = 0;
    for (Track& track : tracks) {
      track.points = Thinned(track.points, tolerance_m);
      points += track.points.size();
    }
    if (points <= most_points || tolerance_m > kCoarsest_m) return tracks;
  }
}

}  // namespace skein

#include "core/path_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double kBehindLeader_m = 3'000;
constexpr double kEndless_m = 20'000;
// Chords at most this long, so that no bend hides between the places that are looked at.
constexpr double kFirstChord_m = 400;
constexpr double kLeastChord_m = 1;
// A browser draws no more; 1,000 km of straight path are 2,500.
constexpr std::size_t kMaxPoints = 20'000;

Eigen::Vector3d PointAt(const Path& path, double arc_m) {
  const PathPoint point = path.At(arc_m);
  return {point.position.x(), point.position.y(), point.up_m};
}

double DistanceToChord(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d chord = to - from;
  const double length2 = chord.squaredNorm();
  const double along = length2 > 0 ? std::clamp((point - from).dot(chord) / length2, 0., 1.) : 0;
  return (point - from - along * chord).norm();
}

struct Sampler {
  const Path& path;
  double chord_error_m;
  std::vector<Eigen::Vector3d> points;

  // Adds what lies after `from` up to and with `to`. Looks at three places, as a bend and its counter-bend
  // meet midway.
  void Add(double from_arc_m, const Eigen::Vector3d& from, double to_arc_m, const Eigen::Vector3d& to) {
    const double length_m = to_arc_m - from_arc_m;
    bool close = length_m < kLeastChord_m || points.size() >= kMaxPoints;
    if (!close) {
      close =
          length_m <= kFirstChord_m &&
          std::ranges::all_of(std::initializer_list<double>{0.25, 0.5, 0.75}, [&](double share) {
            return DistanceToChord(PointAt(path, from_arc_m + share * length_m), from, to) <= chord_error_m;
          });
    }
    if (close) {
      points.push_back(to);
      return;
    }
    const double middle_arc_m = from_arc_m + length_m / 2;
    const Eigen::Vector3d middle = PointAt(path, middle_arc_m);
    Add(from_arc_m, from, middle_arc_m, middle);
    Add(middle_arc_m, middle, to_arc_m, to);
  }
};

}  // namespace

std::vector<Eigen::Vector3d> SampleLine(const Path& path, double from_arc_m, double to_arc_m,
                                        double chord_error_m) {
  Sampler sampler{path, chord_error_m, {}};
  const Eigen::Vector3d from = PointAt(path, from_arc_m);
  sampler.points.push_back(from);
  if (to_arc_m > from_arc_m) sampler.Add(from_arc_m, from, to_arc_m, PointAt(path, to_arc_m));
  return std::move(sampler.points);
}

DrawnStretch StretchToDraw(const Path& path, double leader_arc_m, bool straight_on) {
  DrawnStretch stretch{.from_arc_m = leader_arc_m - kBehindLeader_m};
  const double last_m = std::max(leader_arc_m, path.end_arc_m());
  if (path.closed()) {
    const double start_m = std::max(leader_arc_m, *path.loop_start_m());
    stretch.to_arc_m = start_m + path.end_arc_m() - *path.loop_start_m();
    return stretch;
  }
  const double curvature_per_m = std::abs(path.At(path.end_arc_m() + 1).curvature_per_m);
  stretch.to_arc_m = last_m;
  if (curvature_per_m > 1e-6) {
    stretch.to_arc_m += 2 * std::numbers::pi / curvature_per_m;
  } else if (straight_on) {
    stretch.to_arc_m += kEndless_m;
    stretch.endless = true;
  }
  return stretch;
}

}  // namespace skein

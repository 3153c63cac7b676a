#include "core/path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/path_pieces.h"
#include "core/path_profile.h"

namespace skein {
namespace {

/// A single ramp that turns further than this is not a path that anybody planned; it would only cost
/// quadrature time.
constexpr double kMostRampTurn_rad = 100;

/// Nominal length of the one piece of a path that goes straight on for good.
constexpr double kStraightPiece_m = 1000;

void Check(const PathPiece& piece) {
  const bool finite = std::isfinite(piece.length_m) && piece.start.allFinite() &&
                      std::isfinite(piece.start_course_rad) && std::isfinite(piece.start_curvature_per_m) &&
                      std::isfinite(piece.end_curvature_per_m);
  if (!finite) throw std::invalid_argument("path: a piece is not finite");
  if (!(piece.length_m > 0)) throw std::invalid_argument("path: the length of a piece is not positive");
  const double steepest =
      std::max(std::abs(piece.start_curvature_per_m), std::abs(piece.end_curvature_per_m));
  if (piece.start_curvature_per_m != piece.end_curvature_per_m &&
      steepest * piece.length_m > kMostRampTurn_rad) {
    throw std::invalid_argument("path: a curvature ramp turns too far");
  }
}

void Check(const std::vector<ProfileKnot>& profile) {
  if (profile.empty()) throw std::invalid_argument("path: no altitude and speed");
  for (size_t i = 0; i < profile.size(); ++i) {
    const ProfileKnot& knot = profile[i];
    const bool finite = std::isfinite(knot.arc_m) && std::isfinite(knot.up_m) &&
                        std::isfinite(knot.speed_m_s) && std::isfinite(knot.up_slope) &&
                        std::isfinite(knot.up_slope_rate_per_m) && std::isfinite(knot.speed_slope_per_s) &&
                        std::isfinite(knot.speed_slope_rate_per_m_s);
    if (!finite) throw std::invalid_argument("path: a knot of the profile is not finite");
    if (!(knot.speed_m_s > 0)) throw std::invalid_argument("path: a planned speed is not positive");
    if (i > 0 && !(knot.arc_m > profile[i - 1].arc_m)) {
      throw std::invalid_argument("path: the knots of the profile do not rise");
    }
  }
}

/// The first knot past arc_m, or the number of knots.
size_t KnotAfter(const std::vector<ProfileKnot>& profile, double arc_m) {
  const auto after = std::upper_bound(profile.begin(), profile.end(), arc_m,
                                      [](double arc, const ProfileKnot& knot) { return arc < knot.arc_m; });
  return static_cast<size_t>(after - profile.begin());
}

/// One of the two quantities of a profile (UpOf or SpeedOf); level outside of the knots.
template <typename Quantity>
Jet ProfileAt(const std::vector<ProfileKnot>& profile, size_t after, double arc_m, Quantity of) {
  if (after == 0) return {of(profile.front()).value};
  const ProfileKnot& before = profile[after - 1];
  if (after == profile.size()) return {of(before).value};
  const ProfileKnot& next = profile[after];
  return Quintic(of(before), of(next), next.arc_m - before.arc_m, arc_m - before.arc_m);
}

constexpr auto kUp = [](const ProfileKnot& knot) { return UpOf(knot); };
constexpr auto kSpeed = [](const ProfileKnot& knot) { return SpeedOf(knot); };

}  // namespace

Path Path::Straight(const Eigen::Vector2d& start, double course_rad, double up_m, double speed_m_s) {
  return Path(0, {{kStraightPiece_m, start, course_rad, 0, 0}}, {{0, up_m, speed_m_s}}, std::nullopt);
}

Path::Path(double start_arc_m, std::vector<PathPiece> pieces, std::vector<ProfileKnot> profile,
           std::optional<double> loop_start_m)
    : pieces_(std::move(pieces)), profile_(std::move(profile)), loop_start_m_(loop_start_m) {
  if (!std::isfinite(start_arc_m)) throw std::invalid_argument("path: its start is not finite");
  if (pieces_.empty()) throw std::invalid_argument("path: no piece");
  piece_arcs_m_ = {start_arc_m};
  for (const PathPiece& piece : pieces_) {
    Check(piece);
    piece_arcs_m_.push_back(piece_arcs_m_.back() + piece.length_m);
  }
  Check(profile_);
  if (!loop_start_m_) return;
  if (!(*loop_start_m_ >= start_arc_m && *loop_start_m_ < end_arc_m())) {
    throw std::invalid_argument("path: the loop does not start within its pieces");
  }
  const PathPiece& last = pieces_.back();
  // At() would fold the end onto the loop's start.
  lap_turn_rad_ = PoseOn(last, last.length_m).course_rad - At(*loop_start_m_).course_rad;
}

Path::Folded Path::Fold(double arc_m) const {
  if (!loop_start_m_ || arc_m < end_arc_m()) return {arc_m, 0};
  const double laps = std::floor((arc_m - *loop_start_m_) / lap_m());
  return {arc_m - laps * lap_m(), laps};
}

size_t Path::PieceAt(double arc_m) const {
  const auto after = std::upper_bound(piece_arcs_m_.begin() + 1, piece_arcs_m_.end() - 1, arc_m);
  return static_cast<size_t>(after - piece_arcs_m_.begin()) - 1;
}

PathPoint Path::ShapeAt(double arc_m) const {
  const double arc = Fold(arc_m).arc_m;
  const size_t knot = KnotAfter(profile_, arc);
  const Jet up = ProfileAt(profile_, knot, arc, kUp);
  const Jet speed = ProfileAt(profile_, knot, arc, kSpeed);
  PathPoint point;
  point.arc_m = arc_m;
  point.up_m = up.value;
  point.up_slope = up.slope;
  point.up_slope_rate_per_m = up.rate;
  point.speed_m_s = speed.value;
  point.speed_slope_per_s = speed.slope;
  point.speed_slope_rate_per_m_s = speed.rate;
  if (arc >= end_arc_m() && !closed()) {
    point.curvature_per_m = pieces_.back().end_curvature_per_m;
  } else if (arc >= start_arc_m()) {
    const size_t index = PieceAt(arc);
    const PathPiece& piece = pieces_[index];
    point.curvature_slope_per_m2 = CurvatureSlope(piece);
    point.curvature_per_m =
        piece.start_curvature_per_m + point.curvature_slope_per_m2 * (arc - piece_arcs_m_[index]);
  }
  return point;
}

PathPoint Path::At(double arc_m) const {
  const auto [arc, laps] = Fold(arc_m);
  Pose pose;
  if (arc < start_arc_m()) {
    const PathPiece& first = pieces_.front();
    pose = {first.start - (start_arc_m() - arc) * Direction(first.start_course_rad), first.start_course_rad};
  } else if (arc >= end_arc_m() && !closed()) {
    const PathPiece& last = pieces_.back();
    const Pose end = PoseOn(last, last.length_m);
    const double curvature = last.end_curvature_per_m;
    pose = PoseOn({1, end.position, end.course_rad, curvature, curvature}, arc - end_arc_m());
  } else {
    const size_t index = PieceAt(arc);
    pose = PoseOn(pieces_[index], arc - piece_arcs_m_[index]);
  }
  PathPoint point = ShapeAt(arc_m);
  point.position = pose.position;
  point.course_rad = pose.course_rad + laps * lap_turn_rad_;
  return point;
}

double Path::SpeedAt(double arc_m) const {
  const double arc = Fold(arc_m).arc_m;
  return ProfileAt(profile_, KnotAfter(profile_, arc), arc, kSpeed).value;
}

}  // namespace skein

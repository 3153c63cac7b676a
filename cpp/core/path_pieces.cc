#include "core/path_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skein {
namespace {

constexpr double kLeastLength_m = 1e-6;

/// Nodes and weights on [0, 1] of Gauss-Legendre quadrature with six points. Over a panel that turns by at
/// most one radian its error is below 1e-12 of the panel's length.
struct Node {
  double at;
  double weight;
};
constexpr std::array<Node, 6> kNodes{{{0.0337652428984240, 0.0856622461895852},
                                      {0.1693953067668677, 0.1803807865240693},
                                      {0.3806904069584016, 0.2339569672863455},
                                      {0.6193095930415985, 0.2339569672863455},
                                      {0.8306046932331323, 0.1803807865240693},
                                      {0.9662347571015760, 0.0856622461895852}}};

double Sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

}  // namespace

Eigen::Vector2d Direction(double course_rad) { return {std::cos(course_rad), std::sin(course_rad)}; }

double CurvatureSlope(const PathPiece& piece) {
  return (piece.end_curvature_per_m - piece.start_curvature_per_m) / piece.length_m;
}

Pose PoseOn(const PathPiece& piece, double along_m) {
  const double curvature = piece.start_curvature_per_m;
  const double slope = CurvatureSlope(piece);
  const double turned = along_m * (curvature + 0.5 * slope * along_m);
  Pose pose{piece.start, piece.start_course_rad + turned};
  if (slope == 0) {
    pose.position += along_m * Sinc(0.5 * turned) * Direction(piece.start_course_rad + 0.5 * turned);
    return pose;
  }
  const double steepest = std::max(std::abs(curvature), std::abs(curvature + slope * along_m));
  const int panels = 1 + static_cast<int>(steepest * std::abs(along_m));
  const double panel_m = along_m / panels;
  for (int panel = 0; panel < panels; ++panel) {
    for (const Node& node : kNodes) {
      const double at = (panel + node.at) * panel_m;
      pose.position +=
          node.weight * panel_m * Direction(piece.start_course_rad + at * (curvature + 0.5 * slope * at));
    }
  }
  return pose;
}

Turn MakeTurn(double turn_rad, double curvature_per_m, double slope_per_m2) {
  const double angle = std::abs(turn_rad);
  if (angle == 0) return {};
  const double peak = std::min(curvature_per_m, std::sqrt(angle * slope_per_m2));
  const double arc_m = std::max(0.0, angle / peak - peak / slope_per_m2);
  return {turn_rad, std::copysign(peak, turn_rad), peak / slope_per_m2, arc_m};
}

double Chord(const Turn& turn) {
  if (turn.turn_rad == 0) return 0;
  // Twice the first half, seen along the bisector: the ramp by quadrature, half of the arc in closed form.
  const double peak = std::abs(turn.peak_curvature_per_m);
  const double half_rad = 0.5 * std::abs(turn.turn_rad);
  const PathPiece ramp{turn.ramp_m, {0, 0}, -half_rad, 0, peak};
  return 2 * (PoseOn(ramp, turn.ramp_m).position.x() + std::sin(0.5 * peak * turn.arc_m) / peak);
}

void PieceChain::Lay(double length_m, double start_curvature_per_m, double end_curvature_per_m) {
  if (length_m < kLeastLength_m) return;
  pieces_.push_back({length_m, end_.position, end_.course_rad, start_curvature_per_m, end_curvature_per_m});
  end_ = PoseOn(pieces_.back(), length_m);
  arc_m_ += length_m;
}

void PieceChain::Lay(const Turn& turn) {
  Lay(turn.ramp_m, 0, turn.peak_curvature_per_m);
  Lay(turn.arc_m, turn.peak_curvature_per_m, turn.peak_curvature_per_m);
  Lay(turn.ramp_m, turn.peak_curvature_per_m, 0);
}

}  // namespace skein

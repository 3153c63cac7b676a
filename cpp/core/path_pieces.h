#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/path.h"

namespace skein {

/// A place on a path in the plane.
struct Pose {
  Eigen::Vector2d position{0, 0};  ///< east, north
  double course_rad = 0;
};

/// Unit vector along a course, east and north.
Eigen::Vector2d Direction(double course_rad);

/// The pose `along_m` past the start of a piece; before 0 and past the piece's length its curvature goes on
/// changing. Arcs and straights in closed form, clothoids by Gauss-Legendre quadrature (error far below 1
/// mm).
Pose PoseOn(const PathPiece& piece, double along_m);

/// Change of curvature per metre along a piece.
double CurvatureSlope(const PathPiece& piece);

/// A turn from straight to straight: curvature ramps up, stays, ramps down. A turn too small for the full
/// curvature has no arc and a lower peak. Symmetric, so its chord points half the turn to the left of the
/// course it starts with.
struct Turn {
  double turn_rad = 0;              ///< left positive
  double peak_curvature_per_m = 0;  ///< left positive
  double ramp_m = 0;                ///< length of either ramp
  double arc_m = 0;                 ///< length at the peak

  double length_m() const { return 2 * ramp_m + arc_m; }
};

/// The turn of at most this curvature and change of curvature (both > 0).
Turn MakeTurn(double turn_rad, double curvature_per_m, double slope_per_m2);

/// From the turn's start to its end along half its angle; negative when the turn has carried it back.
double Chord(const Turn& turn);

/// Lays piece after piece, each where the last one ended.
class PieceChain {
 public:
  explicit PieceChain(const Pose& start, double arc_m = 0)
      : start_arc_m_(arc_m), arc_m_(arc_m), end_(start) {}

  /// Nothing is laid for a length below a micrometre.
  void Lay(double length_m, double start_curvature_per_m, double end_curvature_per_m);
  void LayStraight(double length_m) { Lay(length_m, 0, 0); }
  void Lay(const Turn& turn);

  const Pose& end() const { return end_; }
  double start_arc_m() const { return start_arc_m_; }
  double arc_m() const { return arc_m_; }
  const std::vector<PathPiece>& pieces() const { return pieces_; }

 private:
  double start_arc_m_;
  double arc_m_;
  Pose end_;
  std::vector<PathPiece> pieces_;
};

}  // namespace skein

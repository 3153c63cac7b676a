#include "core/path_section.h"

#include <algorithm>
#include <cmath>

#include "core/path_pieces.h"
#include "core/path_profile.h"

namespace skein {
namespace {

/// Places closer together than this are one.
constexpr double kSameArc_m = 1e-6;

/// Below this a piece is straight: it would take 1,000 km to leave its line by half a metre.
constexpr double kStraight_per_m = 1e-12;

/// `from_m`, all of `arcs_m` between (repeated in each lap) and `to_m`, rising.
std::vector<double> Breaks(const Path& path, const std::vector<double>& arcs_m, double from_m, double to_m) {
  std::vector<double> breaks{from_m, to_m};
  const auto add = [&](double arc) {
    if (arc > from_m && arc < to_m) breaks.push_back(arc);
  };
  for (const double arc : arcs_m) {
    if (!path.closed() || arc < path.end_arc_m()) add(arc);
  }
  if (path.closed()) {
    const double loop_start = *path.loop_start_m();
    const double first_lap = std::max(1.0, std::floor((from_m - loop_start) / path.lap_m()));
    for (double lap = first_lap; loop_start + lap * path.lap_m() < to_m; ++lap) {
      add(loop_start + lap * path.lap_m());
      for (const double arc : arcs_m) {
        if (arc > loop_start && arc < path.end_arc_m()) add(arc + lap * path.lap_m());
      }
    }
  }
  std::sort(breaks.begin(), breaks.end());
  const auto same = [](double one, double other) { return other - one < kSameArc_m; };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
  breaks.back() = to_m;
  return breaks;
}

std::vector<double> PieceBreaks(const Path& path, double from_m, double to_m) {
  std::vector<double> arcs{path.start_arc_m()};
  for (const PathPiece& piece : path.pieces()) arcs.push_back(arcs.back() + piece.length_m);
  return Breaks(path, arcs, from_m, to_m);
}

}  // namespace

PathSection Section(const Path& path, double from_m, double to_m) {
  from_m = std::min(std::max(from_m, path.start_arc_m()), to_m);
  PathSection section{from_m, {}, {}};
  const std::vector<double> breaks = PieceBreaks(path, from_m, to_m);
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    const PathPoint start = path.At(breaks[i]);
    // Rounding may have put the start into the piece before; the middle is safe.
    const PathPoint middle = path.At(breaks[i] + 0.5 * length);
    const double half = 0.5 * length * middle.curvature_slope_per_m2;
    section.pieces.push_back({length, start.position, start.course_rad, middle.curvature_per_m - half,
                              middle.curvature_per_m + half});
  }
  std::vector<double> arcs;
  for (const ProfileKnot& knot : path.profile()) arcs.push_back(knot.arc_m);
  for (const double arc : Breaks(path, arcs, from_m, to_m)) {
    const PathPoint point = path.At(arc);
    section.knots.push_back(MakeKnot(arc, UpOf(point), SpeedOf(point)));
  }
  return section;
}

std::optional<double> StraightPoint(const Path& path, double arc_m) {
  const double from = std::max(arc_m, path.start_arc_m());
  const double to = path.closed() ? std::max(from, *path.loop_start_m()) + path.lap_m()
                                  : std::max(from, path.end_arc_m()) + 1;
  const std::vector<double> ahead = PieceBreaks(path, from, to);
  for (size_t i = 0; i + 1 < ahead.size(); ++i) {
    const PathPoint middle = path.At(0.5 * (ahead[i] + ahead[i + 1]));
    const double half = 0.5 * (ahead[i + 1] - ahead[i]) * middle.curvature_slope_per_m2;
    if (std::abs(middle.curvature_per_m - half) < kStraight_per_m) return ahead[i];
    if (i + 2 == ahead.size()) break;
    if (std::abs(middle.curvature_per_m + half) < kStraight_per_m) return ahead[i + 1];
  }
  const std::vector<double> behind =
      PieceBreaks(path, path.start_arc_m(), std::max(from, path.start_arc_m() + 1));
  for (size_t i = behind.size() - 1; i > 0; --i) {
    const PathPoint middle = path.At(0.5 * (behind[i - 1] + behind[i]));
    const double half = 0.5 * (behind[i] - behind[i - 1]) * middle.curvature_slope_per_m2;
    if (std::abs(middle.curvature_per_m - half) < kStraight_per_m) return behind[i - 1];
  }
  return std::nullopt;
}

bool Curves(const Path& path, double from_m, double to_m) {
  const std::vector<double> breaks = PieceBreaks(path, std::min(from_m, to_m), to_m);
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    const PathPoint middle = path.At(0.5 * (breaks[i] + breaks[i + 1]));
    if (std::abs(middle.curvature_per_m) > kStraight_per_m || std::abs(middle.curvature_slope_per_m2) > 0)
      return true;
  }
  return false;
}

}  // namespace skein

#include "core/path_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

using std::numbers::pi;

/// Least distance of a point from a chain of chords.
double Distance(const Eigen::Vector3d& point, const std::vector<Eigen::Vector3d>& line) {
  double least = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector3d chord = line[i] - line[i - 1];
    const double along = std::clamp((point - line[i - 1]).dot(chord) / chord.squaredNorm(), 0., 1.);
    least = std::min(least, (point - line[i - 1] - along * chord).norm());
  }
  return least;
}

/// East 1000 m, a left half circle of 500 m radius, west 1000 m; 200 m up on the way.
Path HalfTurn() {
  const double arc_m = pi * 500;
  return Path(
      0, {{1000, {0, 0}, 0, 0, 0}, {arc_m, {1000, 0}, 0, 1. / 500, 1. / 500}, {1000, {1000, 1000}, pi, 0, 0}},
      {{0, 100, 50}, {2000 + arc_m, 300, 50}}, std::nullopt);
}

TEST(SampleLine, StaysWithinTheChordErrorEverywhere) {
  const Path path = HalfTurn();
  const auto line = SampleLine(path, 0, path.end_arc_m());
  for (double arc_m = 0; arc_m <= path.end_arc_m(); arc_m += 5) {
    const PathPoint point = path.At(arc_m);
    EXPECT_LE(Distance({point.position.x(), point.position.y(), point.up_m}, line), 2.0) << arc_m;
  }
  EXPECT_LT(line.size(), 60u);
  EXPECT_NEAR((line.front() - Eigen::Vector3d(0, 0, 100)).norm(), 0, 1e-6);
  EXPECT_NEAR((line.back() - Eigen::Vector3d(0, 1000, 300)).norm(), 0, 1e-6);
}

TEST(SampleLine, IsFewPointsForAStraightPathAndOneForNoLength) {
  const Path path = Path::Straight({0, 0}, pi / 2, 1000, 50);
  EXPECT_LE(SampleLine(path, 0, 20'000).size(), 80u);
  EXPECT_EQ(SampleLine(path, 100, 100).size(), 1u);
}

TEST(StretchToDraw, GoesFromBehindTheLeaderToTheEnd) {
  const Path path = HalfTurn();
  const DrawnStretch stretch = StretchToDraw(path, 500, false);
  EXPECT_DOUBLE_EQ(stretch.from_arc_m, -2500);
  EXPECT_DOUBLE_EQ(stretch.to_arc_m, path.end_arc_m());
  EXPECT_FALSE(stretch.endless);
}

TEST(StretchToDraw, IsTwentyKilometresOfAStraightPath) {
  const Path path = Path::Straight({0, 0}, 0, 1000, 50);
  const DrawnStretch stretch = StretchToDraw(path, 100'000, true);
  EXPECT_DOUBLE_EQ(stretch.from_arc_m, 97'000);
  EXPECT_DOUBLE_EQ(stretch.to_arc_m, 120'000);
  EXPECT_TRUE(stretch.endless);
}

TEST(StretchToDraw, GoesOnceRoundACircleForGood) {
  const double round_m = 2 * pi * 500;
  const Path circle(0, {{round_m, {0, 0}, 0, 1. / 500, 1. / 500}}, {{0, 100, 50}}, std::nullopt);
  const DrawnStretch stretch = StretchToDraw(circle, 10'000, true);
  EXPECT_NEAR(stretch.to_arc_m, 10'000 + round_m, 1e-6);
  EXPECT_FALSE(stretch.endless);
}

TEST(StretchToDraw, GoesOnceRoundALoop) {
  const double round_m = 2 * pi * 500;
  const Path loop(0, {{1000, {-1000, 0}, 0, 0, 0}, {round_m, {0, 0}, 0, 1. / 500, 1. / 500}}, {{0, 100, 50}},
                  1000);
  EXPECT_NEAR(StretchToDraw(loop, 0, false).to_arc_m, 1000 + round_m, 1e-6);
  EXPECT_NEAR(StretchToDraw(loop, 50'000, false).to_arc_m, 50'000 + round_m, 1e-6);
}

}  // namespace
}  // namespace skein

#include "core/path.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/path_pieces.h"
#include "core/path_profile.h"
#include "path_checks.h"

namespace skein {
namespace {

Path OnePiece(const PathPiece& piece) { return Path(0, {piece}, {{0, 100, 50}}, std::nullopt); }

TEST(Path, StraightRunsOnItsCourseBothWays) {
  const Path path = Path::Straight({10, 20}, M_PI / 2, 300, 45);
  for (const double arc : {-5000.0, 0.0, 700.0, 1000.0, 90000.0}) {
    const PathPoint point = path.At(arc);
    EXPECT_NEAR(point.position.x(), 10, 1e-9);
    EXPECT_NEAR(point.position.y(), 20 + arc, 1e-9);
    EXPECT_EQ(point.course_rad, M_PI / 2);
    EXPECT_EQ(point.curvature_per_m, 0);
    EXPECT_EQ(point.up_m, 300);
    EXPECT_EQ(point.speed_m_s, 45);
    EXPECT_EQ(path.SpeedAt(arc), 45);
  }
}

TEST(Path, ArcRunsOnItsCircleAndOnAndOnPastItsEnd) {
  const double radius = 2000;
  const Path path = OnePiece({1000, {radius, 0}, M_PI / 2, 1 / radius, 1 / radius});
  for (const double arc : {0.0, 1.0, 999.0, 1000.0, M_PI * radius, 100000.0}) {
    const double angle = arc / radius;
    const PathPoint point = path.At(arc);
    EXPECT_NEAR(point.position.x(), radius * std::cos(angle), 1e-6);
    EXPECT_NEAR(point.position.y(), radius * std::sin(angle), 1e-6);
    EXPECT_NEAR(point.course_rad, M_PI / 2 + angle, 1e-9);
    EXPECT_EQ(point.curvature_per_m, 1 / radius);
  }
  const PathPoint before = path.At(-300);
  EXPECT_NEAR(before.position.x(), radius, 1e-9);
  EXPECT_NEAR(before.position.y(), -300, 1e-9);
  EXPECT_EQ(before.curvature_per_m, 0);
}

TEST(Path, ClothoidAgreesWithFineIntegration) {
  // Three kinds: a usual ramp, one through zero, and one that winds up by more than a full turn.
  for (const PathPiece& piece :
       {PathPiece{500, {1, 2}, 3, 0, 1.0 / 2000}, PathPiece{800, {0, 0}, -3, -0.002, 0.0025},
        PathPiece{3000, {0, 0}, 1, 0.0001, 0.006}}) {
    const Path path = OnePiece(piece);
    Eigen::Vector2d at = piece.start;
    const double step = 0.01;
    for (int i = 0; i < static_cast<int>(piece.length_m / step); ++i) {
      const double along = (i + 0.5) * step;
      const double slope = (piece.end_curvature_per_m - piece.start_curvature_per_m) / piece.length_m;
      const double course =
          piece.start_course_rad + piece.start_curvature_per_m * along + slope * along * along / 2;
      at += step * Eigen::Vector2d(std::cos(course), std::sin(course));
      if (i % 1000 == 999) {
        ASSERT_LT((path.At((i + 1) * step).position - at).norm(), 1e-5) << i;
      }
    }
  }
}

TEST(Path, QuinticMeetsItsEndsAndItsSlopesAreItsDerivatives) {
  const Jet start{100, 0.1, 1e-4}, end{180, -0.05, -2e-4};
  const double length = 900;
  const Jet first = Quintic(start, end, length, 0), last = Quintic(start, end, length, length);
  EXPECT_NEAR(first.value, start.value, 1e-12);
  EXPECT_NEAR(first.slope, start.slope, 1e-12);
  EXPECT_NEAR(first.rate, start.rate, 1e-12);
  EXPECT_NEAR(last.value, end.value, 1e-9);
  EXPECT_NEAR(last.slope, end.slope, 1e-12);
  EXPECT_NEAR(last.rate, end.rate, 1e-12);
  for (double x = 10; x < length; x += 10) {
    const double h = 0.01;
    const Jet before = Quintic(start, end, length, x - h), after = Quintic(start, end, length, x + h);
    const Jet at = Quintic(start, end, length, x);
    ASSERT_NEAR((after.value - before.value) / (2 * h), at.slope, 1e-7);
    ASSERT_NEAR((after.slope - before.slope) / (2 * h), at.rate, 1e-9);
  }
}

TEST(Path, LevelEndedQuinticHasTheExtremesThatTheLimitsUse) {
  double slope = 0, rate = 0, product = 0;
  for (double u = 0; u <= 1; u += 1e-4) {
    const Jet at = Quintic({}, {1, 0, 0}, 1, u);
    slope = std::max(slope, at.slope);
    rate = std::max(rate, at.rate);
    product = std::max(product, at.slope * at.rate);
  }
  EXPECT_NEAR(slope, kQuinticSlope, 1e-3);
  EXPECT_NEAR(rate, kQuinticRate, 1e-3);
  EXPECT_NEAR(product, kQuinticProduct, 1e-2);
}

TEST(Path, MergedProfilesAreBothProfilesExactly) {
  const std::vector<Mark> up{{0, {100}}, {1000, {200}}, {3000, {50}}};
  const std::vector<Mark> speed{{200, {50}}, {1000, {50}}, {2500, {70}}};
  const Path path(0, {{5000, {0, 0}, 0, 0, 0}}, Merge(up, speed, 0, 3000), std::nullopt);
  for (double arc = -100; arc < 4000; arc += 7) {
    const PathPoint point = path.At(arc);
    ASSERT_NEAR(point.up_m, Through(up, arc).value, 1e-9) << arc;
    ASSERT_NEAR(point.up_slope, Through(up, arc).slope, 1e-12) << arc;
    ASSERT_NEAR(point.speed_m_s, Through(speed, arc).value, 1e-9) << arc;
    ASSERT_NEAR(path.SpeedAt(arc), point.speed_m_s, 1e-12);
  }
}

TEST(Path, AClosedPathRepeatsAndItsCourseUnwindsOnward) {
  // A circle of 1 km radius as a loop after a straight of 500 m.
  const double radius = 1000, lap = 2 * M_PI * radius;
  PieceChain chain({{0, -500}, M_PI / 2}, 250);
  chain.LayStraight(500);
  chain.Lay(lap, 1 / radius, 1 / radius);
  const Path path(250, chain.pieces(), {{250, 100, 50}, {750, 120, 60}}, 750);
  EXPECT_NEAR(path.lap_m(), lap, 1e-9);
  EXPECT_NEAR(path.lap_turn_rad(), 2 * M_PI, 1e-12);
  for (double arc = 750; arc < 750 + lap; arc += 100) {
    const PathPoint once = path.At(arc), later = path.At(arc + 3 * lap);
    EXPECT_LT((once.position - later.position).norm(), 1e-6);
    EXPECT_NEAR(later.course_rad - once.course_rad, 6 * M_PI, 1e-9);
    EXPECT_NEAR(later.curvature_per_m, once.curvature_per_m, 1e-12);
    EXPECT_EQ(later.up_m, 120);
    EXPECT_EQ(later.arc_m, arc + 3 * lap);
  }
  EXPECT_NEAR(path.At(250).position.y(), -500, 1e-12);
  EXPECT_EQ(path.At(0).up_m, 100);
}

TEST(Path, RefusesWhatIsNoPath) {
  const PathPiece piece{100, {0, 0}, 0, 0, 0};
  const std::vector<ProfileKnot> level{{0, 100, 50}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Path(0, {}, level, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {piece}, {}, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(nan, {piece}, level, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {{0, {0, 0}, 0, 0, 0}}, level, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {{100, {nan, 0}, 0, 0, 0}}, level, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {{1e9, {0, 0}, 0, 0, 1}}, level, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {piece}, {{0, 100, 0}}, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {piece}, {{0, 100, 50}, {0, 100, 50}}, std::nullopt), std::invalid_argument);
  EXPECT_THROW(Path(0, {piece}, level, 100), std::invalid_argument);
  EXPECT_THROW(Path(0, {piece}, level, -1), std::invalid_argument);
}

TEST(Turn, ASmallTurnNeverReachesFullCurvature) {
  const Turn small = MakeTurn(0.01, 1.0 / 500, 1e-5);
  EXPECT_EQ(small.arc_m, 0);
  EXPECT_LT(small.peak_curvature_per_m, 1.0 / 500);
  EXPECT_NEAR(small.peak_curvature_per_m * small.ramp_m, 0.01, 1e-12);
  const Turn large = MakeTurn(-2, 1.0 / 500, 1e-5);
  EXPECT_EQ(large.peak_curvature_per_m, -1.0 / 500);
  EXPECT_NEAR(large.ramp_m, 200, 1e-9);
  EXPECT_NEAR(large.peak_curvature_per_m * (large.ramp_m + large.arc_m), -2, 1e-12);
  EXPECT_EQ(MakeTurn(0, 1, 1).length_m(), 0);
  EXPECT_EQ(Chord(MakeTurn(0, 1, 1)), 0);
}

}  // namespace
}  // namespace skein

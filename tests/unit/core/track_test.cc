#include "core/track.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

/// Where a UAV that flies evenly between the points is.
Eigen::Vector3d At(const std::vector<TrackPoint>& points, double t_s) {
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].t_s < t_s) ++i;
  const TrackPoint& from = points[i - 1];
  const TrackPoint& to = points[i];
  return from.position + (t_s - from.t_s) / (to.t_s - from.t_s) * (to.position - from.position);
}

TEST(Thinned, KeepsTwoPointsOfAnEvenFlight) {
  std::vector<TrackPoint> points;
  for (int i = 0; i <= 100; ++i) points.push_back({0.5 * i, {0, 25. * i, 1000}});
  const auto thinned = Thinned(points, 2);
  ASSERT_EQ(thinned.size(), 2u);
  EXPECT_EQ(thinned.back().t_s, 50);
}

TEST(Thinned, KeepsChangesOfSpeedOnAStraightLine) {
  std::vector<TrackPoint> points;
  for (int i = 0; i <= 100; ++i)
    points.push_back({0.5 * i, {i < 50 ? 25. * i : 1250 + 40. * (i - 50), 0, 0}});
  const auto thinned = Thinned(points, 2);
  ASSERT_EQ(thinned.size(), 3u);
  EXPECT_EQ(thinned[1].t_s, 25);
}

TEST(Thinned, IsNowhereFartherOffThanAllowed) {
  std::vector<TrackPoint> points;
  for (int i = 0; i <= 2000; ++i) {
    const double t = 0.5 * i;
    points.push_back({t, {2000 * std::sin(t / 40), 2000 * std::cos(t / 31), 1000 + 50 * std::sin(t / 100)}});
  }
  const auto thinned = Thinned(points, 2);
  EXPECT_LT(thinned.size(), points.size() / 3);
  for (const TrackPoint& point : points)
    EXPECT_LE((At(thinned, point.t_s) - point.position).norm(), 2 + 1e-9);
}

TEST(Thinned, MakesTracksCoarserUntilTheyFit) {
  std::vector<Track> tracks(20);
  for (Track& track : tracks) {
    for (int i = 0; i <= 2000; ++i) track.points.push_back({0.5 * i, {1000 * std::sin(i / 20.), 0, 0}});
  }
  std::size_t points = 0;
  for (const Track& track : Thinned(tracks, 1'000)) {
    points += track.points.size();
    EXPECT_GE(track.points.size(), 2u);
  }
  EXPECT_LE(points, 1'000u);
}

}  // namespace
}  // namespace skein

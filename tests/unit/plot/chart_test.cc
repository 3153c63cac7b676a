#include "plot/chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::plot {
namespace {

TEST(TickValues, LieOneTwoOrFiveApart) {
  EXPECT_EQ(TickValues(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(TickValues(0, 400, 4), (std::vector<double>{0, 100, 200, 300, 400}));
  EXPECT_EQ(TickValues(-1100, 1100, 4), (std::vector<double>{-1000, -500, 0, 500, 1000}));
}

TEST(TickValues, StayWithinTheInterval) {
  for (const double value : TickValues(49.3, 57.6, 8)) {
    EXPECT_GE(value, 49.3);
    EXPECT_LE(value, 57.6);
  }
}

TEST(Simplified, DropsWhatLiesOnTheWayAndKeepsCorners) {
  const auto points = Simplified({{0, 0}, {1, 0}, {2, 0}, {3, 5}, {4, 0}, {5, 0}}, 0.1);
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[1].x, 2);
  EXPECT_EQ(points[2].y, 5);
}

TEST(Simplified, NeverStraysFartherThanItsTolerance) {
  std::vector<Point> wave;
  for (int i = 0; i <= 1000; ++i) wave.push_back({i * 0.1, 20 * std::sin(i * 0.05)});
  const auto points = Simplified(wave, 0.5);
  EXPECT_LT(points.size(), 200u);
  std::size_t next = 1;
  for (const Point& point : wave) {
    while (points[next].x < point.x) ++next;
    const double share = (point.x - points[next - 1].x) / (points[next].x - points[next - 1].x);
    const double y = points[next - 1].y + share * (points[next].y - points[next - 1].y);
    // Nearer than 0.5 across the line, whose slope is 10 at most here.
    EXPECT_LT(std::abs(y - point.y), 0.5 * std::sqrt(1 + 100));
  }
}

TEST(Simplified, TakesFewPointsAsTheyAre) {
  EXPECT_TRUE(Simplified({}, 1).empty());
  EXPECT_EQ(Simplified({{1, 1}}, 1).size(), 1u);
  EXPECT_EQ(Simplified({{1, 1}, {1, 1}, {1, 1}}, 1).size(), 2u);
}

TEST(Text, EscapesWhatSvgWouldRead) {
  EXPECT_NE(Text(0, 0, "R < 150 & \"H\"", "start").find("R &lt; 150 &amp; &quot;H&quot;"), std::string::npos);
}

TEST(Draw, HasNoCurveWithoutPoints) {
  Chart chart;
  chart.curves.resize(1);
  const std::string svg = Draw(chart, {0, 0, 400, 300});
  EXPECT_EQ(svg.find("polyline"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace skein::plot

#include "cli/geojson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace skein::cli {
namespace {

const config::Origin kOrigin{.latitude_deg = 40, .longitude_deg = 116, .altitude_m = 100};

class GeoJsonTest : public testing::Test {
 protected:
  ~GeoJsonTest() override { std::filesystem::remove(file_); }

  PathFile Read(const std::string& text) {
    std::ofstream(file_) << text;
    return ReadPathFile(file_, kOrigin);
  }

  /// What a refused file is told, without the file's name.
  std::string Refusal(const std::string& text) {
    try {
      Read(text);
    } catch (const config::ConfigError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(file_.string() + ": "), 0U) << what;
      return what.substr(file_.string().size() + 2);
    }
    return "not refused";
  }

  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".geojson");
};

TEST_F(GeoJsonTest, ReadsALineStringWithAltitudeAsThirdCoordinate) {
  const auto path = Read(R"({"type": "Feature", "properties": {"speed_m_s": 50}, "geometry":
      {"type": "LineString", "coordinates": [[116, 40, 1100], [116, 40.01, 1100], [116.01, 40.01, 1200]]}})");
  ASSERT_EQ(path.waypoints.size(), 3U);
  EXPECT_FALSE(path.closed);
  EXPECT_NEAR(path.waypoints[0].east_m, 0, 1e-6);
  EXPECT_NEAR(path.waypoints[0].north_m, 0, 1e-6);
  EXPECT_DOUBLE_EQ(path.waypoints[0].up_m, 1000);
  // A degree of latitude at 40 degrees is M pi / 180 = 111,035 m long on WGS-84, one of longitude 85,394 m;
  // at 1,000 m above the origin both grow by (1 + 1100 / 6.37e6).
  EXPECT_NEAR(path.waypoints[1].north_m, 1110.35 * (1 + 1100 / 6.36e6), 0.1);
  EXPECT_NEAR(path.waypoints[2].east_m, 853.94 * (1 + 1200 / 6.39e6), 0.2);
  EXPECT_DOUBLE_EQ(path.waypoints[2].up_m, 1100);
  EXPECT_DOUBLE_EQ(path.waypoints[2].speed_m_s, 50);
}

TEST_F(GeoJsonTest, FliesPointsOfOneAltitudeLevelHoweverFarTheyAre) {
  const auto path =
      Read(R"({"type": "Feature", "properties": {"speed_m_s": 50, "altitude_m": 900}, "geometry":
      {"type": "LineString", "coordinates": [[116, 40], [116.5, 40.5]]}})");
  EXPECT_DOUBLE_EQ(path.waypoints[0].up_m, 800);
  EXPECT_DOUBLE_EQ(path.waypoints[1].up_m, 800);
}

TEST_F(GeoJsonTest, ReadsPointsInTheirOrderAndCarriesAltitudeAndSpeedOn) {
  const auto path = Read(R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"altitude_m": 600, "speed_m_s": 45},
       "geometry": {"type": "Point", "coordinates": [116.02, 40]}},
      {"type": "Feature", "properties": {"turn_radius_m": 2500},
       "geometry": {"type": "Point", "coordinates": [116.01, 40]}},
      {"type": "Feature", "properties": null, "geometry": {"type": "Point", "coordinates": [116, 40, 700]}}]})");
  ASSERT_EQ(path.waypoints.size(), 3U);
  EXPECT_GT(path.waypoints[0].east_m, path.waypoints[1].east_m);
  EXPECT_DOUBLE_EQ(path.waypoints[1].up_m, 500);
  EXPECT_DOUBLE_EQ(path.waypoints[1].speed_m_s, 45);
  EXPECT_DOUBLE_EQ(path.waypoints[1].turn_radius_m, 2500);
  EXPECT_DOUBLE_EQ(path.waypoints[2].up_m, 600);
}

TEST_F(GeoJsonTest, TakesALineThatEndsWhereItStartsAndAPolygonAsClosed) {
  const std::string ring = "[[116, 40], [116.1, 40], [116.1, 40.1], [116, 40]]";
  for (const std::string& geometry : std::vector<std::string>{
           R"("LineString", "coordinates": )" + ring, R"("Polygon", "coordinates": [)" + ring + "]"}) {
    const auto path = Read(
        R"({"type": "Feature", "properties": {"altitude_m": 600, "speed_m_s": 45}, "geometry": {"type": )" +
        geometry + "}}");
    EXPECT_TRUE(path.closed) << geometry;
    EXPECT_EQ(path.waypoints.size(), 3U) << geometry;
  }
}

TEST_F(GeoJsonTest, TakesBackWhatItWrites) {
  const PathFile path{
      true,
      {{.east_m = 12345.678, .north_m = -2345.5, .up_m = 1000, .speed_m_s = 50, .turn_radius_m = 2000},
       {.east_m = -7000, .north_m = 90000, .up_m = 0, .speed_m_s = 61.5},
       {.east_m = 0, .north_m = 0, .up_m = -20, .speed_m_s = 40}}};
  const auto back = Read(WritePath(path, {{0, 0, 1000}, {100, 0, 1000}}, kOrigin));
  EXPECT_TRUE(back.closed);
  ASSERT_EQ(back.waypoints.size(), path.waypoints.size());
  for (std::size_t i = 0; i < path.waypoints.size(); ++i) {
    EXPECT_NEAR(back.waypoints[i].east_m, path.waypoints[i].east_m, 1e-3);
    EXPECT_NEAR(back.waypoints[i].north_m, path.waypoints[i].north_m, 1e-3);
    EXPECT_NEAR(back.waypoints[i].up_m, path.waypoints[i].up_m, 1e-3);
    EXPECT_EQ(back.waypoints[i].speed_m_s, path.waypoints[i].speed_m_s);
    EXPECT_EQ(back.waypoints[i].turn_radius_m, path.waypoints[i].turn_radius_m);
  }
}

TEST_F(GeoJsonTest, TakesALineWhoseFlownIsNoBooleanForAPath) {
  const auto path = Read(R"({"type": "Feature", "properties": {"speed_m_s": 50, "flown": "no"}, "geometry":
      {"type": "LineString", "coordinates": [[116, 40, 1100], [116, 40.01, 1100]]}})");
  EXPECT_EQ(path.waypoints.size(), 2U);
}

TEST_F(GeoJsonTest, SaysWhatIsWrongAndWhere) {
  const auto line = [](const std::string& coordinates) {
    return R"({"type": "Feature", "properties": {"speed_m_s": 50}, "geometry": {"type": "LineString", "coordinates": )" +
           coordinates + "}}";
  };
  EXPECT_EQ(Refusal("{").find("is no JSON"), 0U);
  EXPECT_EQ(Refusal("[1E999]").find("is no JSON"), 0U);
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += R"({"type":"FeatureCollection","features":[)";
  EXPECT_EQ(Refusal(deep), "nests too deeply for GeoJSON");
  EXPECT_EQ(Refusal("[]"), "must be an object");
  EXPECT_EQ(Refusal("{}"), "has no \"type\": this is no GeoJSON");
  EXPECT_EQ(Refusal(R"({"type": "MultiPoint"})"),
            "/type: \"MultiPoint\" is no path; give a LineString, a Polygon or Points");
  EXPECT_EQ(Refusal(line("[]")), "a path needs at least two points");
  EXPECT_EQ(Refusal(line("[[116, 40]]")),
            "/geometry/coordinates/0: has no altitude: give a third coordinate, or the property altitude_m");
  EXPECT_EQ(Refusal(R"({"type": "LineString", "coordinates": [[116, 40, 900]]})"),
            "/coordinates/0: has no speed: give the property speed_m_s");
  EXPECT_EQ(Refusal(line("[[116, 40, 900], [116, 95, 900]]")),
            "/geometry/coordinates/1/1: must be -90.0 .. 90.0, not 95");
  EXPECT_EQ(Refusal(line("[[116, \"40\", 900]]")), "/geometry/coordinates/0/1: must be a number");
  EXPECT_EQ(Refusal(line("[[116]]")),
            "/geometry/coordinates/0: must be [longitude, latitude] or [longitude, latitude, altitude]");
  EXPECT_NE(Refusal(line("[[40, 80, 900]]")).find("km from the fleet's origin"), std::string::npos);
  EXPECT_EQ(
      Refusal(R"({"type": "FeatureCollection", "features": [)" + line("[[116, 40, 900], [116, 40.1, 900]]") +
              "," + line("[[116, 40, 900], [116, 40.1, 900]]") + "]}"),
      "holds more than one path");
}

}  // namespace
}  // namespace skein::cli

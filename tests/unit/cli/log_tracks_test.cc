// What a recording looks like on maps and in figures: skein log geojson, kml, plot.

#include <cmath>

#include "cli/geo_point.h"
#include "unit/cli/log_fixture.h"

namespace skein::cli {
namespace {

const config::Origin kOrigin{40.08, 116.58, 30};

std::vector<nlohmann::json> OfKind(const nlohmann::json& collection, const std::string& kind) {
  std::vector<nlohmann::json> features;
  for (const auto& feature : collection["features"]) {
    if (feature["properties"]["kind"] == kind) features.push_back(feature);
  }
  return features;
}

/// Of a time in the first minute.
double SecondsOf(const std::string& time) {
  EXPECT_EQ(time.substr(0, 17), "2020-01-01T00:00:");
  return std::stod(time.substr(17));
}

/// The cells of a row of CSV without quotes.
std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST_F(LogTest, DrawsATrackForEachUavWithATimeForEachPosition) {
  const auto json = Json({"geojson", flight()});
  EXPECT_EQ(json["type"], "FeatureCollection");
  const auto tracks = OfKind(json, "track");
  // UAV3 was not heard for 10 s: two pieces.
  ASSERT_EQ(tracks.size(), 4U);
  EXPECT_EQ(tracks[0]["properties"]["callsign"], "UAV1");
  EXPECT_EQ(tracks[2]["properties"]["vehicle_id"], 3);
  EXPECT_NEAR(SecondsOf(tracks[2]["properties"]["end"]), 20, 0.1);
  EXPECT_NEAR(SecondsOf(tracks[3]["properties"]["begin"]), 30, 0.1);
  for (const auto& track : tracks) {
    const auto& coordinates = track["geometry"]["coordinates"];
    const auto& times = track["properties"]["coordinateProperties"]["times"];
    ASSERT_GE(coordinates.size(), 2U);
    ASSERT_EQ(coordinates.size(), times.size());
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  }
}

TEST_F(LogTest, KeepsEveryStateWhereItWas) {
  const auto json =
      Json({"geojson", flight(), "--points", "--tolerance-m", "0", "--from", "2", "--to", "3.01"});
  const auto points = OfKind(json, "track");
  const auto rows =
      Lines(Output({"csv", flight(), "--channel", "FLEET_STATE", "--from", "2", "--to", "3.01"}));
  ASSERT_EQ(points.size() + 1, rows.size());
  // Points are by UAV, rows by time: the first point of UAV1 is the first row.
  const auto cells = Cells(rows[1]);
  const auto& position = points[0]["geometry"]["coordinates"];
  const Eigen::Vector3d place = ToLocal({position[0], position[1], position[2]}, kOrigin);
  EXPECT_NEAR(place.x(), std::stod(cells[8]), 1e-3);
  EXPECT_NEAR(place.y(), std::stod(cells[9]), 1e-3);
  EXPECT_NEAR(position[2], 30 + std::stod(cells[10]), 1e-3);
  EXPECT_EQ(points[0]["properties"]["time"], "2020-01-01T00:00:02.000Z");
}

TEST_F(LogTest, DrawsPathsAndEventsWhereTheyHappened) {
  const auto json = Json({"geojson", flight()});
  const auto paths = OfKind(json, "path");
  ASSERT_FALSE(paths.empty());
  EXPECT_EQ(paths[0]["properties"]["formation"], "Alpha");
  EXPECT_GE(paths[0]["geometry"]["coordinates"].size(), 2U);
  bool is_told = false;
  for (const auto& event : OfKind(json, "event")) {
    if (event["properties"]["code"] != "link_lost") continue;
    is_told = true;
    EXPECT_EQ(event["properties"]["vehicle_id"], 3);
    // Where it was heard last, 1,000 m north of where it began at 20 s.
    const auto& position = event["geometry"]["coordinates"];
    EXPECT_NEAR(ToLocal({position[0], position[1], position[2]}, kOrigin).y(), 1000, 60);
  }
  EXPECT_TRUE(is_told);
}

TEST_F(LogTest, WritesTracksForGoogleEarth) {
  const std::string kml = Output({"kml", flight(), "--tolerance-m", "0"});
  EXPECT_EQ(kml.substr(0, 5), "<?xml");
  EXPECT_EQ(Count(kml, "<gx:Track>"), 4U);
  EXPECT_EQ(Count(kml, "</gx:Track>"), 4U);
  const auto points = OfKind(Json({"geojson", flight(), "--points", "--tolerance-m", "0"}), "track");
  EXPECT_EQ(Count(kml, "<gx:coord>"), points.size());
  EXPECT_EQ(Count(kml, "<gx:coord>") + Count(kml, "<TimeStamp>"), Count(kml, "<when>"));
  for (const char* tag : {"Placemark", "Folder", "Document", "gx:MultiTrack", "LineString", "Point"}) {
    EXPECT_EQ(Count(kml, std::string("<") + tag + ">"), Count(kml, std::string("</") + tag + ">")) << tag;
  }
  EXPECT_EQ(Count(kml, "<altitudeMode>absolute</altitudeMode>"),
            Count(kml, "<gx:Track>") + Count(kml, "<gx:MultiTrack>") + Count(kml, "<LineString>") +
                Count(kml, "<Point>"));
  EXPECT_LT(Output({"kml", flight()}).size(), kml.size() / 4);
}

TEST_F(LogTest, PlotsTheFiguresOfThePaper) {
  const std::string eight = Output({"plot", flight()});
  EXPECT_EQ(Count(eight, "<polyline"), 6U * 3);
  EXPECT_EQ(Count(eight, "stroke=\"#c00000\""), 5U * 2 + 1)
      << "cut and restored, in five charts and the legend";
  EXPECT_NE(eight.find("Three with a drop"), std::string::npos);
  const std::string six = Output({"plot", flight(), "--figure", "6"});
  EXPECT_EQ(Count(six, "<polyline"), 4U * 3);
  EXPECT_NE(Refusal({"plot", flight(), "--flight", "2"}).find("there is no flight 2"), std::string::npos);
}

TEST_F(LogTest, KeepsTheFlightsOfARecordingApart) {
  const std::string second = In("second.lcm");
  Fly(second, [](config::Scenario& flown) {
    flown.name = "Another one";
    flown.timeline.clear();
  });
  // As if the scenario had been loaded in flight: the simulator's session rises with each start.
  const std::string both = In("both.lcm");
  experiment::ExperimentOptions options;
  options.duration_s = 5;
  options.logs = false;
  options.log = In("later.lcm");
  options.start = bus::SimulatedExecutor::kStart + 100 * bus::kSecond;
  experiment::RunExperiment(config::LoadScenario(SKEIN_SOURCE_DIR "/tests/unit/cli/three_with_a_drop.json"),
                            options);
  Write("both.lcm", Read(second) + Read(In("later.lcm")));
  EXPECT_EQ(Json({"info", both, "--json"})["flights"].size(), 2U);
  EXPECT_NE(Output({"plot", both}).find("Another one"), std::string::npos);
  EXPECT_NE(Output({"plot", both, "--flight", "2"}).find("Three with a drop"), std::string::npos);
  EXPECT_EQ(OfKind(Json({"geojson", both}), "track").size(), 6U);
  EXPECT_EQ(Run({"diff", both, second}).exit_code, 0);
  EXPECT_EQ(Json({"diff", both, both, "--flight", "2", "--json"})["vehicles"][0]["to_s"], 5);
}

}  // namespace
}  // namespace skein::cli

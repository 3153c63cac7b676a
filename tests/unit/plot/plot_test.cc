#include "plot/plot.h"

#include <gtest/gtest.h>

#include <string>

namespace skein::plot {
namespace {

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

FlightRecord ThreeUavs() {
  FlightRecord flight;
  for (int id = 1; id <= 3; ++id) {
    VehicleRecord& vehicle = flight.vehicles.emplace_back();
    vehicle.id = id;
    vehicle.callsign = "UAV" + std::to_string(id);
    for (int i = 0; i < 10; ++i) {
      const double value = i * i * id;
      vehicle.t_s.push_back(i);
      vehicle.slot_t_s.push_back(i);
      for (auto* column : {&vehicle.east_m, &vehicle.north_m, &vehicle.up_m, &vehicle.speed_m_s,
                           &vehicle.forward_error_m, &vehicle.left_error_m, &vehicle.up_error_m}) {
        column->push_back(value);
      }
    }
  }
  return flight;
}

TEST(Plot, DrawsErrorsAndSpeedAsFigureSix) {
  const std::string svg = PlotSvg("Assembly", {ThreeUavs()}, {.figure = Figure::kAssembly});
  EXPECT_EQ(Count(svg, "<polyline"), 4U * 3);
  for (const char* title : {"Forward error", "Left error", "Up error", ">Speed<"}) {
    EXPECT_EQ(Count(svg, title), 1U) << title;
  }
  EXPECT_EQ(Count(svg, "Track"), 0U);
}

TEST(Plot, DrawsAltitudeTrackAndLinkEventsAsFigureEight) {
  FlightRecord flight = ThreeUavs();
  flight.link_changes_s = {3, 5};
  const std::string svg = PlotSvg("Drop", {flight}, {.time_label = "Time of the scenario [s]"});
  EXPECT_EQ(Count(svg, "<polyline"), 6U * 3);
  EXPECT_EQ(Count(svg, "Time of the scenario [s]"), 5U);
  EXPECT_EQ(Count(svg, ">Track<"), 1U);
  EXPECT_EQ(Count(svg, "link cut or restored"), 1U);
  // Two lines in each chart over time, one sample in the legend.
  EXPECT_EQ(Count(svg, "stroke=\"#c00000\""), 5U * 2 + 1);
}

TEST(Plot, DrawsAFlightWithoutAnything) {
  EXPECT_NE(PlotSvg("Empty", {{}}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace skein::plot

// What the web page computes or shows by itself, held equal to this library by the files in tests/golden.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/formation.h"
#include "core/paper_law.h"
#include "core/skein_law.h"

namespace skein {
namespace {

const std::string kFolder = SKEIN_SOURCE_DIR "/tests/golden/";

std::vector<std::vector<std::string>> Rows(const std::string& file) {
  std::ifstream input(kFolder + file);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(input, line);
  while (std::getline(input, line)) {
    std::vector<std::string> cells;
    std::stringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

void Set(const std::string& control, const std::string& name, double value) {
  if (control == "paper") {
    PaperParametersFrom({{name, value}});
  } else {
    SkeinLawParametersFrom({{name, value}});
  }
}

std::map<std::string, double> Presets() {
  const MixerGains m;
  const PaperParameters paper;
  const SkeinLawParameters s;
  std::map<std::string, double> presets = {{"paper/k_ex", m.k_ex},
                                           {"paper/k_ev", m.k_ev},
                                           {"paper/k_ey", m.k_ey},
                                           {"paper/k_ephi", m.k_ephi},
                                           {"paper/k_ez", m.k_ez},
                                           {"paper/k_emu", m.k_emu},
                                           {"paper/saturation_forward_m", m.saturation_forward_m},
                                           {"paper/saturation_left_m", m.saturation_left_m},
                                           {"paper/saturation_up_m", m.saturation_up_m},
                                           {"skein/position_per_s", s.position_per_s},
                                           {"skein/speed_per_s", s.speed_per_s},
                                           {"skein/course_per_s", s.course_per_s},
                                           {"skein/climb_per_s", s.climb_per_s},
                                           {"skein/integral_per_s2", s.integral_per_s2},
                                           {"skein/integral_zone_m", s.integral_zone_m},
                                           {"skein/approach_share", s.approach_share},
                                           {"skein/lateral_m_s2", s.lateral_m_s2},
                                           {"skein/lateral_m_s", s.lateral_m_s},
                                           {"skein/vertical_m_s2", s.vertical_m_s2},
                                           {"skein/vertical_m_s", s.vertical_m_s},
                                           {"skein/margin_m_s", s.margin_m_s}};
  const std::map<std::string, PidGains> loops = {
      {"speed", paper.speed}, {"course", paper.course}, {"climb", paper.climb}};
  for (const auto& [name, loop] : loops) {
    presets["paper/" + name + "_p"] = loop.p;
    presets["paper/" + name + "_i"] = loop.i;
    presets["paper/" + name + "_d"] = loop.d;
    presets["paper/" + name + "_n"] = loop.n;
  }
  return presets;
}

std::string ShapesAsCsv() {
  std::ostringstream csv;
  csv.precision(10);
  csv << "shape,count,spacing_m,lead_m,index,forward_m,left_m\n";
  for (const Shape shape : {Shape::kTriangle, Shape::kColumn, Shape::kLineAbreast, Shape::kEchelonLeft,
                            Shape::kEchelonRight, Shape::kDiamond, Shape::kVee}) {
    for (const int count : {1, 2, 3, 4, 5, 7, 10, 13}) {
      const auto slots = ShapeSlots(shape, count, 300, 700);
      for (std::size_t i = 0; i < slots.size(); ++i) {
        csv << Name(shape) << ',' << count << ",300,700," << i << ',' << slots[i].forward_m << ','
            << slots[i].left_m << '\n';
      }
    }
  }
  return csv.str();
}

TEST(Golden, ShapesAreThoseOfTheWebPage) {
  if (std::getenv("SKEIN_RENEW_GOLDEN") != nullptr) {
    std::ofstream(kFolder + "shapes.csv") << ShapesAsCsv();
  }
  std::ifstream input(kFolder + "shapes.csv");
  std::stringstream golden;
  golden << input.rdbuf();
  EXPECT_EQ(golden.str(), ShapesAsCsv());
}

TEST(Golden, GainsPresetsAndRangesAreThoseOfTheWebPage) {
  const auto rows = Rows("gains.csv");
  const auto presets = Presets();
  EXPECT_EQ(rows.size(), presets.size());
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 5u);
    const std::string& control = row[0];
    const std::string& name = row[1];
    SCOPED_TRACE(control + "/" + name);
    EXPECT_DOUBLE_EQ(presets.at(control + "/" + name), std::stod(row[2]));
    const double least = std::stod(row[3]);
    EXPECT_NO_THROW(Set(control, name, least));
    EXPECT_THROW(Set(control, name, least > 0 ? 0 : -1e-9), std::invalid_argument);
    const double most = row[4].empty() ? 1e6 : std::stod(row[4]);
    EXPECT_NO_THROW(Set(control, name, most));
    if (!row[4].empty()) {
      EXPECT_THROW(Set(control, name, 1.001 * most), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace skein

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace skein::config {

/// A file that lives as long as this.
class ScenarioFile {
 public:
  explicit ScenarioFile(const std::string& text)
      : path_(std::filesystem::path(testing::TempDir()) /
              ("skein-" + std::to_string(getpid()) + "-" + std::to_string(++count) + ".json")) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~ScenarioFile() { std::filesystem::remove(path_); }
  ScenarioFile(const ScenarioFile&) = delete;
  ScenarioFile& operator=(const ScenarioFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  static inline int count = 0;
  std::filesystem::path path_;
};

/// Three UAVs, of which two fly a custom formation and the third a column of one.
inline nlohmann::json ThreeUavs() {
  return nlohmann::json::parse(R"({
    "name": "Three", "duration_s": 60,
    "origin": {"latitude_deg": 40.08, "longitude_deg": 116.58, "altitude_m": 0},
    "formations": [
      {"id": 1, "shape": "custom",
       "leader": {"east_m": 0, "north_m": 5000, "up_m": 1000, "speed_m_s": 50, "course_deg": 90},
       "slots": [{"vehicle": 1, "forward_m": -1000, "left_m": 0, "up_m": 0},
                 {"vehicle": 2, "forward_m": -1000, "left_m": 500, "up_m": 10}]},
      {"id": 2, "shape": "column", "spacing_m": 300, "vehicles": [3],
       "leader": {"east_m": 9000, "north_m": 5000, "up_m": 1000, "speed_m_s": 50, "course_deg": 0}}],
    "vehicles": [
      {"id": 1, "callsign": "UAV1", "east_m": 1000, "north_m": 3000, "up_m": 800, "speed_m_s": 60, "course_deg": 0},
      {"id": 2, "callsign": "UAV2", "east_m": 0, "north_m": 3000, "up_m": 800, "speed_m_s": 60, "course_deg": 90},
      {"id": 3, "callsign": "UAV3", "east_m": 9000, "north_m": 3000, "up_m": 800, "speed_m_s": 60, "course_deg": 0}],
    "timeline": [{"at_s": 20, "cut_link": 3}, {"at_s": 30, "restore_link": 3}]})");
}

}  // namespace skein::config

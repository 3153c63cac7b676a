#include "experiment/csv_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace skein::experiment {
namespace {

std::string Written(const std::vector<Tick>& ticks) {
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("skein-" + std::to_string(getpid()) + ".csv");
  CsvWriter writer(file);
  for (const Tick& tick : ticks) writer.Add(tick);
  writer.Finish();
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::filesystem::remove(file);
  return text.str();
}

TEST(CsvWriter, StartsWithTheColumnsThatArePromised) {
  EXPECT_EQ(
      Written({}).rfind("t_s,vehicle_id,east_m,north_m,up_m,speed_m_s,course_rad,climb_rad,slot_forward_m,"
                        "slot_left_m,slot_up_m,link,level,",
                        0),
      0u);
}

TEST(CsvWriter, WritesARowPerVehicle) {
  Tick tick;
  tick.t_s = 12.35;
  tick.utime = 13'000'000;
  VehicleTick one;
  one.id = 3;
  one.truth = {
      .east_m = 1, .north_m = -2.5, .up_m = 1000, .speed_m_s = 50.25, .course_rad = 1.5, .climb_rad = -0.1};
  VehicleTick two = one;
  two.id = 4;
  two.formation_id = 1;
  two.slot = slot_status_t{};
  two.slot->forward_error_m = 10.5;
  two.slot->slot_east_m = 11.5;
  two.slot->flown = 1;
  two.uplink = Link::kLate;
  two.proximity = vehicle_proximity_t{};
  two.proximity->level = 2;
  two.heard_utime = 12'800'000;
  two.command = vehicle_command_t{};
  two.command->speed_input_m_s = 55;
  tick.vehicles = {one, two};
  EXPECT_EQ(Written({tick}),
            CsvWriter::Header() +
                "\n12.35,3,1.000,-2.500,1000.000,50.2500,1.500000,-0.100000,,,,up,0,0,,,,,,,,\n"
                "12.35,4,1.000,-2.500,1000.000,50.2500,1.500000,-0.100000,10.500,0.000,0.000,late,2,1,11.500,"
                "0.000,0.000,"
                "1,0.200,55.0000,0.000000,0.000000\n");
}

TEST(CsvWriter, EveryRowHasAsManyFieldsAsTheHeader) {
  Tick tick;
  tick.vehicles.resize(1);
  const std::string text = Written({tick});
  const std::string header = text.substr(0, text.find('\n'));
  const std::string row = text.substr(header.size() + 1);
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
}

TEST(CsvWriter, SaysWhenItCannotWrite) {
  EXPECT_THROW(CsvWriter("/no/such/folder/flight.csv"), std::runtime_error);
  CsvWriter full("/dev/full");
  EXPECT_THROW(full.Finish(), std::runtime_error);
}

}  // namespace
}  // namespace skein::experiment

// Flies paper-assembly and compares it with tests/golden/paper-assembly.csv; README.md there tells how to
// renew that.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "experiment/experiment.h"

namespace skein::experiment {
namespace {

constexpr const char* kFile = SKEIN_SOURCE_DIR "/tests/golden/paper-assembly.csv";
constexpr const char* kHeader = "t_s,forward_error_m,left_error_m,up_error_m,speed_m_s,up_m";
constexpr std::int64_t kTicksPerRow = 40;

using Row = std::array<double, 6>;

// Positions, then speed: far below what anybody would see in a figure, far above what another compiler
// changes.
constexpr Row kTolerance{1e-6, 0.05, 0.05, 0.05, 0.005, 0.05};

std::vector<Row> Fly() {
  std::vector<Row> rows;
  ExperimentOptions options;
  options.on_tick = [&](const Tick& tick) {
    if (tick.number % kTicksPerRow != 0) return;
    const VehicleTick& vehicle = tick.vehicles[0];
    rows.push_back({tick.t_s, vehicle.slot->forward_error_m, vehicle.slot->left_error_m,
                    vehicle.slot->up_error_m, vehicle.truth.speed_m_s, vehicle.truth.up_m});
  };
  RunExperiment(config::LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/paper-assembly.json"), options);
  return rows;
}

void Renew(const std::vector<Row>& rows) {
  std::ofstream file(kFile);
  file << kHeader << '\n' << std::fixed;
  file.precision(3);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) file << (i == 0 ? "" : ",") << row[i];
    file << '\n';
  }
}

std::vector<Row> Read() {
  std::ifstream file(kFile);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, kHeader);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::stringstream fields(line);
    Row row{};
    for (double& value : row) {
      fields >> value;
      fields.ignore(1);
    }
    rows.push_back(row);
  }
  return rows;
}

TEST(GoldenCurve, OfPaperAssemblyIsFlownAgain) {
  const std::vector<Row> flown = Fly();
  if (std::getenv("SKEIN_RENEW_GOLDEN") != nullptr) Renew(flown);
  const std::vector<Row> golden = Read();
  ASSERT_EQ(flown.size(), 151u);  // 0 .. 300 s, each 2 s
  ASSERT_EQ(golden.size(), flown.size());
  for (std::size_t i = 0; i < golden.size(); ++i) {
    for (std::size_t column = 0; column < kTolerance.size(); ++column) {
      ASSERT_NEAR(flown[i][column], golden[i][column], kTolerance[column] + 0.0005)
          << "column " << column << " of " << kHeader << " at " << golden[i][0] << " s";
    }
  }
}

}  // namespace
}  // namespace skein::experiment

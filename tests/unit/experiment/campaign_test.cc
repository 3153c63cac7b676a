// Campaigns as their users start them, and what their rows say.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "experiment/campaign_row.h"
#include "experiment/quantile.h"
#include "system/process.h"

namespace skein::experiment {
namespace {

using testing::Finished;
using testing::RunToEnd;

const std::string kProgram = SKEIN_BIN_DIR "/flight-experiment";
const std::string kScenario = SKEIN_SOURCE_DIR "/scripts/scenarios/varied-link-drop.json";
const std::string kPaper = SKEIN_SOURCE_DIR "/scripts/scenarios/paper-link-drop.json";

class CampaignProgram : public ::testing::Test {
 protected:
  CampaignProgram() : folder_(testing::FreshFolder("skein-campaign")) {}
  ~CampaignProgram() override { std::filesystem::remove_all(folder_); }

  std::string File(const std::string& name) const { return folder_ + "/" + name; }

  static std::string Contents(const std::string& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  static std::vector<std::string> Lines(const std::string& file) {
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  /// Short flights, cuts included where they are as soon as can be.
  Finished Fly(const std::string& csv, int runs, int seed, int jobs,
               const std::string& duration_s = "150") const {
    return RunToEnd({kProgram, kScenario, "--runs", std::to_string(runs), "--seed", std::to_string(seed),
                     "--jobs", std::to_string(jobs), "--duration", duration_s, "--csv", File(csv)},
                    testing::Seconds(120));
  }

 private:
  std::string folder_;
};

/// The summary, of which only the last line may differ from run to run.
std::string WithoutRealTime(const std::string& output) {
  return output.substr(0, output.find("  Real time: "));
}

TEST_F(CampaignProgram, FliesTheSameRunsWhateverTheirNumberAndJobs) {
  const Finished alone = Fly("alone.csv", 6, 11, 1);
  ASSERT_EQ(alone.exit_code, 0) << alone.output;
  const Finished together = Fly("together.csv", 6, 11, 2);
  ASSERT_EQ(together.exit_code, 0) << together.output;
  EXPECT_EQ(Contents(File("together.csv")), Contents(File("alone.csv")));
  EXPECT_EQ(WithoutRealTime(together.output), WithoutRealTime(alone.output));

  const auto rows = Lines(File("alone.csv"));
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0], CampaignHeader());
  EXPECT_EQ(rows[0].substr(0, 5), "seed,");
  ASSERT_EQ(Fly("one.csv", 1, 14, 1).exit_code, 0);
  EXPECT_EQ(Lines(File("one.csv")).at(1), rows[4]) << "seed 14, by itself and as the fourth of six";
  for (int i = 1; i <= 6; ++i) {
    EXPECT_EQ(rows[i].substr(0, 3), std::to_string(10 + i) + ",");
    EXPECT_NE(rows[i].substr(3), rows[i % 6 + 1].substr(3)) << "runs are alike";
  }
}

TEST_F(CampaignProgram, IsTheSameSplitByGnuParallel) {
  ASSERT_EQ(Fly("whole.csv", 7, 1, 2).exit_code, 0);
  const Finished whole =
      RunToEnd({kProgram, "--merge", File("whole.csv"), "--plot", File("whole.svg")}, testing::Seconds(30));
  const std::string fly = kProgram + " " + kScenario + " --duration 150 --jobs 1 --runs ";
  const Finished split =
      RunToEnd({"bash", "-c",
                "set -e; cd " + File("") +
                    "; parallel --version | grep -q '^GNU parallel'; parallel --will-cite -j 2 '" + fly +
                    "3 --seed {} --csv part-{}.csv >/dev/null' ::: 4 1; " + fly +
                    "1 --seed 7 --csv part-7.csv >/dev/null; " + kProgram +
                    " --merge part-*.csv --csv merged.csv --plot merged.svg"},
               testing::Seconds(120));
  ASSERT_EQ(split.exit_code, 0) << split.output << "\n(GNU parallel is Debian's package parallel)";
  EXPECT_EQ(Contents(File("merged.csv")), Contents(File("whole.csv")));
  EXPECT_EQ(split.output, whole.output);
  EXPECT_EQ(Contents(File("merged.svg")), Contents(File("whole.svg")));
  EXPECT_GT(Contents(File("merged.svg")).size(), 10000u);
}

TEST_F(CampaignProgram, LeavesWholeRowsWhenInterrupted) {
  testing::Process campaign(
      {kProgram, kScenario, "--runs", "100000", "--jobs", "2", "--csv", File("flown.csv")});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (Lines(File("flown.csv")).size() < 4 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  campaign.Signal(SIGINT);
  EXPECT_EQ(campaign.WaitForEnd(testing::Seconds(20)), 1) << campaign.output();
  EXPECT_NE(campaign.output().find("interrupted"), std::string::npos) << campaign.output();
  EXPECT_NE(campaign.output().find("All runs: "), std::string::npos) << campaign.output();
  const CampaignTable table = MergeCampaigns({File("flown.csv")});
  EXPECT_GE(table.rows.size(), 3u);
  EXPECT_TRUE(table.warnings.empty());
  EXPECT_EQ(Contents(File("flown.csv")).back(), '\n');
}

TEST_F(CampaignProgram, RefusesWhatDoesNotGoTogether) {
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), kProgram);
    const Finished ended = RunToEnd(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.output;
    return ended.output;
  };
  EXPECT_NE(refusal({}).find("name a scenario"), std::string::npos);
  EXPECT_NE(refusal({kScenario, kPaper, "--runs", "2"}).find("--runs flies one scenario"), std::string::npos);
  EXPECT_NE(
      refusal({kScenario, "--runs", "2", "--log", File("a.lcm")}).find("--log goes with single flights"),
      std::string::npos);
  EXPECT_NE(refusal({kScenario, "--jobs", "2"}).find("--runs"), std::string::npos);
  EXPECT_NE(refusal({kScenario, "--runs", "0"}).find("--runs"), std::string::npos);
  EXPECT_NE(refusal({kPaper, "--vary"}).find("has no \"vary\" block"), std::string::npos);
  EXPECT_NE(refusal({kScenario, "--runs", "1", "--csv", "/nowhere/a.csv"})
                .find("/nowhere/a.csv: cannot be written"),
            std::string::npos);
  EXPECT_NE(refusal({"--merge", File("none.csv")}).find("none.csv: cannot be read"), std::string::npos);
  EXPECT_NE(refusal({"--merge", kPaper}).find("is no CSV of flight-experiment --runs"), std::string::npos);
}

TEST_F(CampaignProgram, MergesPartsThatOverlapAndLeavesOutATornRow) {
  CampaignRow row{7, "One, two", "skein", {}};
  row.values[0] = 300;
  const std::string seventh = ToCsv(row);
  row.seed = 18'446'744'073'709'551'615u;
  const std::string last = ToCsv(row);
  std::ofstream(File("a.csv")) << CampaignHeader() << '\n' << last << '\n' << seventh << '\n';
  std::ofstream(File("b.csv")) << CampaignHeader() << '\n' << seventh << "\n8,\"One, two\",sk";
  const CampaignTable table = MergeCampaigns({File("b.csv"), File("a.csv")});
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(ToCsv(table.rows[0]), seventh);
  EXPECT_EQ(ToCsv(table.rows[1]), last);
  ASSERT_EQ(table.warnings.size(), 1u);
  EXPECT_EQ(table.warnings[0], File("b.csv") + ":3: the last row is not whole and was left out");

  const auto refusal = [this](CampaignRow other) {
    std::ofstream(File("c.csv")) << CampaignHeader() << '\n' << ToCsv(other) << '\n';
    try {
      MergeCampaigns({File("a.csv"), File("c.csv")});
    } catch (const config::ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  row.seed = 7;
  row.values[0] = 200;
  EXPECT_NE(refusal(row).find(":2: seed 7 is there already with other results"), std::string::npos);
  row.seed = 9;
  row.control = "paper";
  EXPECT_NE(refusal(row).find("control paper, the others of \"One, two\", control skein"), std::string::npos);
}

LinkDrop Cut(int vehicle_id, double cut_s, std::optional<double> found_s, std::optional<double> restored_s) {
  LinkDrop drop;
  drop.vehicle_id = vehicle_id;
  drop.cut_s = cut_s;
  drop.found_s = found_s;
  drop.restored_s = restored_s;
  return drop;
}

TimedEvent Lost(int vehicle_id, double t_s) {
  TimedEvent lost;
  lost.t_s = t_s;
  lost.event.code = "link_lost";
  lost.event.vehicle_id = vehicle_id;
  return lost;
}

TEST(CampaignRow, TellsFoundMissedLateAndShortCutsApart) {
  Summary summary;
  summary.duration_s = 200;
  summary.drops = {
      Cut(1, 10, 14, 40),                      // found
      Cut(2, 20, 26, 60),                      // found late
      Cut(3, 30, std::nullopt, 33),            // over before it could be found
      Cut(3, 50, std::nullopt, 70),            // missed
      Cut(3, 80, 99, 90),                      // found lost 9 s after its end: for another reason
      Cut(1, 198, std::nullopt, std::nullopt)  // the flight ended first
  };
  summary.events = {Lost(1, 14), Lost(2, 26), Lost(3, 99), Lost(2, 70), Lost(1, 40.5)};
  const CampaignRow row = RowOf(3, summary);
  EXPECT_EQ(row.Value("cuts"), 6);
  EXPECT_EQ(row.Value("found"), 2);
  EXPECT_EQ(row.Value("missed"), 2);
  EXPECT_EQ(row.Value("late"), 1);
  EXPECT_EQ(row.Value("detection_median_s"), 5);
  EXPECT_EQ(row.Value("detection_worst_s"), 6);
  EXPECT_EQ(row.Value("lost_without_cut"), 2) << "UAV 3 at 99 s and UAV 2 at 70 s";
  EXPECT_EQ(row.Value("rejoined_worst_s"), std::nullopt) << "nobody came back into a slot";
  EXPECT_EQ(row.Value("settled_s"), std::nullopt) << "nobody is in a formation";
}

TEST(CampaignRow, SettlesWithItsLastUavAndNotAtAllWhenOneDoesNot) {
  Summary summary;
  summary.vehicles.resize(2);
  for (VehicleSummary& vehicle : summary.vehicles) {
    vehicle.in_formation = true;
    vehicle.settling = {.forward_s = 10, .left_s = 20.123, .up_s = 5, .speed_s = 7};
  }
  summary.vehicles[1].settling.forward_s = 30;
  EXPECT_EQ(RowOf(1, summary).Value("settled_s"), 30);
  EXPECT_EQ(RowOf(1, summary).Value("settled_left_s"), 20.12) << "as the CSV has it";
  summary.vehicles[0].settling.up_s.reset();
  EXPECT_EQ(RowOf(1, summary).Value("settled_s"), std::nullopt);
  EXPECT_EQ(RowOf(1, summary).Value("settled_forward_s"), 30);
}

TEST(Quantile, LiesBetweenTheNumbers) {
  EXPECT_EQ(Quantile({3}, 0.95), 3);
  EXPECT_EQ(Quantile({1, 2, 3, 10}, 0.5), 2.5);
  EXPECT_EQ(Quantile({1, 2, 3, 10}, 0), 1);
  EXPECT_EQ(Quantile({1, 2, 3, 10}, 1), 10);
}

}  // namespace
}  // namespace skein::experiment

#include "experiment/campaign_command.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bus/node_main.h"
#include "experiment/campaign_summary.h"
#include "experiment/output.h"

namespace skein::experiment {
namespace {

/// Whole rows only, each on the disk's side before the next one is flown.
class RowWriter {
 public:
  explicit RowWriter(const std::filesystem::path& file) : file_(file) {
    if (file.empty()) return;
    stream_.open(file, std::ios::binary);
    Write(CampaignHeader());
  }

  void Add(const CampaignRow& row) { Write(ToCsv(row)); }

 private:
  void Write(const std::string& line) {
    if (file_.empty()) return;
    stream_ << line << '\n' << std::flush;
    if (!stream_) throw std::runtime_error(file_.string() + ": could not be written wholly");
  }

  std::filesystem::path file_;
  std::ofstream stream_;
};

void Report(const std::vector<CampaignRow>& rows, const std::filesystem::path& plot) {
  fmt::print("{}", ToText(rows));
  if (!plot.empty()) WriteFile(plot, CampaignSvg(rows));
}

}  // namespace

int Fly(const config::Scenario& scenario, const Campaign& campaign) {
  CheckWritable(campaign.csv);
  CheckWritable(campaign.plot);
  if (!scenario.vary) {
    fmt::print(
        stderr,
        "flight-experiment: {}: has no \"vary\" block: runs differ in the losses and jitter of links alone\n",
        scenario.file.string());
  }
  std::vector<CampaignRow> rows;
  RowWriter writer(campaign.csv);
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress(static_cast<double>(campaign.options.runs), "runs");
    CampaignOptions options = campaign.options;
    options.on_row = [&](const CampaignRow& row) {
      rows.push_back(row);
      writer.Add(row);
    };
    options.on_progress = [&](std::uint64_t flown) { progress.Show(static_cast<double>(flown)); };
    FlyCampaign(scenario, options);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  Report(rows, campaign.plot);
  double flown_s = 0;
  for (const CampaignRow& row : rows) flown_s += row.Value("duration_s").value_or(0);
  fmt::print("  Real time: {:.2f} s, {:.0f} times as fast as the flights, {} at once\n", took.count(),
             flown_s / took.count(), campaign.options.jobs);
  return bus::kExitGood;
}

int Merge(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& csv,
          const std::filesystem::path& plot) {
  const CampaignTable table = MergeCampaigns(parts);
  CheckWritable(csv);
  CheckWritable(plot);
  for (const std::string& warning : table.warnings) fmt::print(stderr, "flight-experiment: {}\n", warning);
  RowWriter writer(csv);
  for (const CampaignRow& row : table.rows) writer.Add(row);
  Report(table.rows, plot);
  return bus::kExitGood;
}

}  // namespace skein::experiment

#include "experiment/campaign_summary.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "experiment/quantile.h"
#include "plot/chart.h"

namespace skein::experiment {
namespace {

using plot::Chart;
using plot::Curve;

constexpr double kWidth = 1080;
constexpr double kChartHeight = 260;
constexpr double kMargin = 16;
constexpr double kTitleHeight = 64;
constexpr std::array<const char*, 6> kPlotted{"settled_s",         "farthest_m",       "least_distance_m",
                                              "detection_worst_s", "rejoined_worst_s", "warnings"};

struct RunValue {
  double value = 0;
  std::uint64_t seed = 0;
};

/// Of the runs that have a value, the least first.
std::vector<RunValue> Sorted(const std::vector<CampaignRow>& rows, std::size_t metric) {
  std::vector<RunValue> samples;
  for (const CampaignRow& row : rows) {
    if (row.values[metric]) samples.push_back({*row.values[metric], row.seed});
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const RunValue& a, const RunValue& b) { return a.value < b.value; });
  return samples;
}

std::vector<double> ValuesOf(const std::vector<RunValue>& samples) {
  std::vector<double> values;
  for (const RunValue& sample : samples) values.push_back(sample.value);
  return values;
}

double Total(const std::vector<CampaignRow>& rows, std::string_view column) {
  return std::accumulate(rows.begin(), rows.end(), 0.0, [&](double sum, const CampaignRow& row) {
    return sum + row.Value(column).value_or(0);
  });
}

/// "1 .. 50, 76 .. 100": campaigns of which a part is missing should show it.
std::string Seeds(const std::vector<CampaignRow>& rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t last = i;
    while (last + 1 < rows.size() && rows[last + 1].seed == rows[last].seed + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(rows[i].seed);
    if (last > i) text += " .. " + std::to_string(rows[last].seed);
    i = last + 1;
  }
  return text;
}

std::string Heading(const std::vector<CampaignRow>& rows) {
  const CampaignRow& first = rows.front();
  return fmt::format("{}{}: {} run{}, seed{} {}", first.scenario,
                     first.control.empty() ? "" : ", control " + first.control, rows.size(),
                     rows.size() == 1 ? "" : "s", rows.size() == 1 ? "" : "s", Seeds(rows));
}

/// How many of the runs have at most so much, over it.
Chart Distribution(const std::vector<CampaignRow>& rows, std::size_t metric) {
  const auto samples = Sorted(rows, metric);
  Chart chart;
  chart.title = kMetrics[metric].title;
  if (samples.size() < rows.size()) {
    chart.title += fmt::format(" ({} of {} runs)", samples.size(), rows.size());
  }
  chart.y_label = "Runs up to this [%]";
  if (samples.empty()) return chart;
  const double room = std::max(0.05 * (samples.back().value - samples.front().value),
                               kMetrics[metric].decimals > 0 ? 0.1 : 0.5);
  Curve curve{{}, {"#0072B2", "", 1.6}};
  const auto step_to = [&](double value, std::size_t count) {
    const double before = curve.points.empty() ? 0 : curve.points.back().y;
    curve.points.push_back({value, before});
    curve.points.push_back({value, 100 * static_cast<double>(count) / static_cast<double>(rows.size())});
  };
  step_to(samples.front().value - room, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) step_to(samples[i].value, i + 1);
  step_to(samples.back().value + room, samples.size());
  chart.curves.push_back(std::move(curve));
  const auto values = ValuesOf(samples);
  chart.vertical_lines = {Quantile(values, 0.5), Quantile(values, 0.95)};
  chart.vertical_stroke = {"#c00000", "9 3 2 3", 1.2};
  return chart;
}

}  // namespace

std::string ToText(const std::vector<CampaignRow>& rows) {
  if (rows.empty()) return "No run was flown.\n";
  std::string text = Heading(rows) + '\n';
  text += fmt::format("  {:<32}{:>6}{:>10}{:>8}{:>10}{:>10}{:>10}{:>10}{:>8}\n", "", "runs", "least",
                      "(seed)", "5 %", "median", "95 %", "greatest", "(seed)");
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    const auto samples = Sorted(rows, i);
    if (samples.empty()) {
      text += fmt::format("  {:<32}{:>6}\n", kMetrics[i].title, 0);
      continue;
    }
    const auto values = ValuesOf(samples);
    const int decimals = kMetrics[i].decimals;
    // Of several runs alike, the one with the least seed.
    const auto greatest = std::find_if(samples.begin(), samples.end(), [&](const RunValue& sample) {
      return sample.value == samples.back().value;
    });
    text +=
        fmt::format("  {:<32}{:>6}{:>10.{}f}{:>8}{:>10.{}f}{:>10.{}f}{:>10.{}f}{:>10.{}f}{:>8}\n",
                    kMetrics[i].title, samples.size(), samples.front().value, decimals, samples.front().seed,
                    Quantile(values, 0.05), decimals, Quantile(values, 0.5), decimals, Quantile(values, 0.95),
                    decimals, samples.back().value, decimals, greatest->seed);
  }
  text += fmt::format(
      "  All runs: {:.0f} cuts of links, {:.0f} found, {:.0f} missed, {:.0f} found after {:g} s; {:.0f} lost "
      "without a cut; {:.0f} advisories, {:.0f} cautions, {:.0f} warnings\n",
      Total(rows, "cuts"), Total(rows, "found"), Total(rows, "missed"), Total(rows, "late"), kDetectionLimitS,
      Total(rows, "lost_without_cut"), Total(rows, "advisories"), Total(rows, "cautions"),
      Total(rows, "warnings"));
  return text;
}

std::string CampaignSvg(const std::vector<CampaignRow>& rows) {
  const double height = kTitleHeight + 3 * kChartHeight + kMargin;
  std::string svg = plot::SvgStart(kWidth, height);
  svg += plot::Text(kWidth / 2, 28, rows.empty() ? "No run was flown" : Heading(rows), "middle", 16,
                    "font-weight=\"bold\"");
  svg += plot::Text(kWidth / 2, 50, "Dashed: median and 95 %", "middle");
  const double chart_width = (kWidth - 2 * kMargin) / 2;
  for (std::size_t i = 0; i < kPlotted.size(); ++i) {
    const auto metric = std::find_if(kMetrics.begin(), kMetrics.end(), [&](const Metric& candidate) {
      return std::string_view(candidate.column) == kPlotted[i];
    });
    const auto index = static_cast<std::size_t>(metric - kMetrics.begin());
    const std::size_t row = i / 2;
    svg += plot::Draw(Distribution(rows, index),
                      {kMargin + chart_width * static_cast<double>(i % 2),
                       kTitleHeight + kChartHeight * static_cast<double>(row), chart_width, kChartHeight});
  }
  return svg + "</svg>\n";
}

}  // namespace skein::experiment

#include "plot/plot.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

#include "plot/chart.h"

namespace skein::plot {
namespace {

constexpr double kWidth = 1080;
constexpr double kChartHeight = 280;
constexpr double kMargin = 16;
constexpr double kTitleHeight = 44;
constexpr double kLegendLine = 20;
constexpr double kLegendEntry = 130;
constexpr std::size_t kMostLegendEntries = 16;
const Stroke kLinkEventStroke{"#c00000", "9 3 2 3", 1.2};

// Okabe and Ito's colours, which colour-blind readers can tell apart; dashes tell curves apart in print.
constexpr std::array<const char*, 7> kColours{"#0072B2", "#E69F00", "#009E73", "#D55E00",
                                              "#CC79A7", "#56B4E9", "#000000"};
constexpr std::array<const char*, 4> kDashes{"", "8 4", "2 3", "8 3 2 3"};

/// One run tells its UAVs apart by colour and dash; several runs of several UAVs have a dash each, the UAVs a
/// colour.
class Style {
 public:
  explicit Style(const std::vector<FlightRecord>& runs) : runs_(runs) {
    for (const FlightRecord& run : runs) most_vehicles_ = std::max(most_vehicles_, run.vehicles.size());
  }

  Stroke Of(std::size_t run, std::size_t vehicle) const {
    const std::size_t colour = runs_.size() > 1 && most_vehicles_ == 1 ? run : vehicle;
    const std::size_t dash = runs_.size() > 1 ? run : vehicle;
    return {kColours[colour % kColours.size()], kDashes[dash % kDashes.size()],
            most_vehicles_ > 10 ? 0.8 : 1.6};
  }

  struct Entry {
    std::string text;
    Stroke stroke;
  };
  std::vector<Entry> Legend() const {
    std::vector<Entry> entries;
    if (runs_.size() > 1) {
      for (std::size_t i = 0; i < runs_.size(); ++i) {
        Stroke stroke = Of(i, 0);
        if (most_vehicles_ > 1) stroke.colour = "#333333";
        entries.push_back({runs_[i].label, stroke});
      }
      if (most_vehicles_ == 1) return entries;
    }
    // More than this nobody tells apart anyway.
    for (std::size_t i = 0; i < most_vehicles_ && most_vehicles_ <= kMostLegendEntries; ++i) {
      Stroke stroke = Of(0, i);
      if (runs_.size() > 1) stroke.dash = "";
      entries.push_back({CallsignsAt(i), stroke});
    }
    return entries;
  }

 private:
  /// "UAV1", or "UAV1 / NORTH1" where runs have different ones.
  std::string CallsignsAt(std::size_t index) const {
    std::vector<std::string> callsigns;
    for (const FlightRecord& run : runs_) {
      if (index >= run.vehicles.size()) continue;
      const std::string& callsign = run.vehicles[index].callsign;
      if (std::find(callsigns.begin(), callsigns.end(), callsign) == callsigns.end())
        callsigns.push_back(callsign);
    }
    return fmt::format("{}", fmt::join(callsigns, " / "));
  }

  const std::vector<FlightRecord>& runs_;
  std::size_t most_vehicles_ = 0;
};

using Column = std::vector<double> VehicleRecord::*;

Chart ChartOf(const std::vector<FlightRecord>& runs, const Style& style, Column x, Column y) {
  Chart chart;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (std::size_t i = 0; i < runs[run].vehicles.size(); ++i) {
      const VehicleRecord& vehicle = runs[run].vehicles[i];
      Curve curve{{}, style.Of(run, i)};
      for (std::size_t k = 0; k < (vehicle.*x).size(); ++k)
        curve.points.push_back({(vehicle.*x)[k], (vehicle.*y)[k]});
      chart.curves.push_back(std::move(curve));
    }
  }
  return chart;
}

/// Columns over time, drawn with the same labels and link events.
struct OverTime {
  const std::vector<FlightRecord>& runs;
  const Style& style;
  const PlotOptions& options;

  Chart operator()(Column x, Column y, const std::string& title, const std::string& label) const;
};

Chart OverTime::operator()(Column x, Column y, const std::string& title, const std::string& label) const {
  Chart chart = ChartOf(runs, style, x, y);
  chart.title = title;
  chart.x_label = options.time_label;
  chart.y_label = label;
  chart.vertical_stroke = kLinkEventStroke;
  for (const FlightRecord& run : runs) {
    chart.vertical_lines.insert(chart.vertical_lines.end(), run.link_changes_s.begin(),
                                run.link_changes_s.end());
  }
  std::sort(chart.vertical_lines.begin(), chart.vertical_lines.end());
  chart.vertical_lines.erase(std::unique(chart.vertical_lines.begin(), chart.vertical_lines.end()),
                             chart.vertical_lines.end());
  return chart;
}

std::vector<Chart> ChartsOf(const std::vector<FlightRecord>& runs, const Style& style,
                            const PlotOptions& options) {
  using V = VehicleRecord;
  const OverTime chart{runs, style, options};
  const Chart forward = chart(&V::slot_t_s, &V::forward_error_m, "Forward error", "Error [m]");
  const Chart left = chart(&V::slot_t_s, &V::left_error_m, "Left error", "Error [m]");
  const Chart up = chart(&V::slot_t_s, &V::up_error_m, "Up error", "Error [m]");
  const Chart speed = chart(&V::t_s, &V::speed_m_s, "Speed", "Speed [m/s]");
  if (options.figure == Figure::kAssembly) return {forward, left, up, speed};
  const Chart altitude = chart(&V::t_s, &V::up_m, "Altitude", "Altitude [m]");
  Chart track = ChartOf(runs, style, &V::east_m, &V::north_m);
  track.title = "Track";
  track.x_label = "East [m]";
  track.y_label = "North [m]";
  track.equal_scales = true;
  return {forward, speed, left, altitude, up, track};
}

}  // namespace

std::string PlotSvg(const std::string& title, const std::vector<FlightRecord>& runs,
                    const PlotOptions& options) {
  const Style style(runs);
  auto legend = style.Legend();
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.link_changes_s.empty(); })) {
    legend.push_back({"link cut or restored", kLinkEventStroke});
  }
  std::size_t longest = 0;
  for (const auto& entry : legend) longest = std::max(longest, entry.text.size());
  const double entry_width = std::max(kLegendEntry, 60 + 7.0 * static_cast<double>(longest));
  const auto per_line =
      std::max<std::size_t>(1, static_cast<std::size_t>((kWidth - 2 * kMargin) / entry_width));
  const std::size_t legend_lines = (legend.size() + per_line - 1) / per_line;
  const double top = kTitleHeight + kLegendLine * static_cast<double>(legend_lines) + 8;

  const std::vector<Chart> charts = ChartsOf(runs, style, options);
  const double height = top + kChartHeight * static_cast<double>(charts.size()) / 2 + kMargin;
  std::string svg = SvgStart(kWidth, height);
  svg += Text(kWidth / 2, 28, title, "middle", 16, "font-weight=\"bold\"");
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const std::size_t line = i / per_line;
    const std::size_t in_line = std::min(per_line, legend.size() - line * per_line);
    const double left = (kWidth - entry_width * static_cast<double>(in_line)) / 2 +
                        entry_width * static_cast<double>(i % per_line);
    const double y = kTitleHeight + kLegendLine * (static_cast<double>(line) + 0.5);
    svg += Sample(left, y, 36, legend[i].stroke);
    svg += Text(left + 42, y + 4, legend[i].text, "start");
  }
  const double chart_width = (kWidth - 2 * kMargin) / 2;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const std::size_t row = i / 2;
    svg += Draw(charts[i], {kMargin + chart_width * static_cast<double>(i % 2),
                            top + kChartHeight * static_cast<double>(row), chart_width, kChartHeight});
  }
  return svg + "</svg>\n";
}

}  // namespace skein::plot

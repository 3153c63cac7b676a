#include "experiment/campaign_row.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "experiment/quantile.h"

namespace skein::experiment {
namespace {

// What is under way when a link comes back may still be too old.
constexpr double kAfterReturnS = 1;

/// The later one; none when one of them never came.
std::optional<double> Later(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(std::max(*a, *b)) : std::nullopt;
}

/// The latest of all UAVs in a formation.
std::optional<double> Latest(const Summary& summary, std::optional<double> Settling::*axis) {
  std::optional<double> latest = 0;
  bool any = false;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (!vehicle.in_formation) continue;
    any = true;
    latest = Later(latest, vehicle.settling.*axis);
  }
  return any ? latest : std::nullopt;
}

double CountEvents(const Summary& summary, const std::string& code) {
  return static_cast<double>(
      std::count_if(summary.events.begin(), summary.events.end(),
                    [&](const TimedEvent& timed) { return timed.event.code == code; }));
}

bool WasFound(const LinkDrop& drop) {
  return drop.found_s && (!drop.restored_s || *drop.found_s <= *drop.restored_s + kAfterReturnS);
}

bool IsOf(const LinkDrop& drop, const TimedEvent& lost) {
  return drop.vehicle_id == lost.event.vehicle_id && lost.t_s >= drop.cut_s &&
         (!drop.restored_s || lost.t_s <= *drop.restored_s + kAfterReturnS);
}

class Measurement {
 public:
  explicit Measurement(CampaignRow& row) : row_(row) {}

  void Set(std::string_view column, const std::optional<double>& value) {
    for (std::size_t i = 0; i < kMetrics.size(); ++i) {
      if (kMetrics[i].column != column) continue;
      if (value) row_.values[i] = std::stod(fmt::format("{:.{}f}", *value + 0.0, kMetrics[i].decimals));
      return;
    }
    throw std::logic_error("no metric " + std::string(column));
  }

 private:
  CampaignRow& row_;
};

void MeasureLinks(const Summary& summary, Measurement& measured) {
  double found = 0;
  double missed = 0;
  double late = 0;
  std::vector<double> detections_s;
  std::optional<double> rejoined_s = 0;
  bool any_return = false;
  for (const LinkDrop& drop : summary.drops) {
    const double lasted_s = drop.restored_s.value_or(summary.duration_s) - drop.cut_s;
    if (WasFound(drop)) {
      ++found;
      detections_s.push_back(*drop.found_s - drop.cut_s);
      if (detections_s.back() > kDetectionLimitS) ++late;
    } else if (lasted_s >= kDetectionLimitS && !drop.told_lost_before) {
      ++missed;
    }
    if (drop.restored_s && WasFound(drop)) {
      any_return = true;
      rejoined_s = Later(rejoined_s,
                         drop.in_slot_s ? std::optional(*drop.in_slot_s - *drop.restored_s) : std::nullopt);
    }
  }
  measured.Set("cuts", static_cast<double>(summary.drops.size()));
  measured.Set("found", found);
  measured.Set("missed", missed);
  measured.Set("late", late);
  if (!detections_s.empty()) {
    std::sort(detections_s.begin(), detections_s.end());
    measured.Set("detection_median_s", Quantile(detections_s, 0.5));
    measured.Set("detection_worst_s", detections_s.back());
  }
  if (any_return) measured.Set("rejoined_worst_s", rejoined_s);
  const auto lost_without_cut =
      std::count_if(summary.events.begin(), summary.events.end(), [&](const TimedEvent& timed) {
        return timed.event.code == "link_lost" &&
               std::none_of(summary.drops.begin(), summary.drops.end(),
                            [&](const LinkDrop& drop) { return IsOf(drop, timed); });
      });
  measured.Set("lost_without_cut", static_cast<double>(lost_without_cut));
}

std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

std::string Cell(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells{""};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

template <typename Number>
std::optional<Number> Parse(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

constexpr std::size_t kFirstMetric = 3;

/// None when it is not a whole row.
std::optional<CampaignRow> ToRow(const std::string& line) {
  const auto cells = Cells(line);
  if (cells.size() != kFirstMetric + kMetrics.size()) return std::nullopt;
  const auto seed = Parse<std::uint64_t>(cells[0]);
  if (!seed) return std::nullopt;
  CampaignRow row{*seed, cells[1], cells[2], {}};
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    const std::string& cell = cells[kFirstMetric + i];
    if (cell.empty()) continue;
    row.values[i] = Parse<double>(cell);
    if (!row.values[i] || !std::isfinite(*row.values[i])) return std::nullopt;
  }
  return row;
}

/// No row is longer, whatever the file is.
constexpr std::size_t kLongestLine = 1 << 16;

/// False at the end. Throws ConfigError for a line that is no row of anybody.
bool ReadLine(std::istream& stream, std::string& line, const std::string& place) {
  line.resize(kLongestLine);
  stream.getline(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(std::strlen(line.c_str()));
  if (stream.fail() && line.size() + 1 == kLongestLine)
    throw config::ConfigError(place + "the line is too long");
  return !stream.fail();
}

class Merger {
 public:
  void Add(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::error_code error;
    if (!stream || std::filesystem::is_directory(file, error)) {
      throw config::ConfigError(file.string() + ": cannot be read");
    }
    std::string line;
    ReadLine(stream, line, file.string() + ": ");
    if (line != CampaignHeader()) {
      throw config::ConfigError(file.string() + ": is no CSV of flight-experiment --runs of this version");
    }
    for (int number = 2;; ++number) {
      const std::string place = fmt::format("{}:{}: ", file.string(), number);
      if (!ReadLine(stream, line, place)) return;
      if (stream.eof()) {
        warnings_.push_back(place + "the last row is not whole and was left out");
        return;
      }
      auto row = ToRow(line);
      if (!row) throw config::ConfigError(place + "not a row of a campaign");
      Add(std::move(*row), place);
    }
  }

  CampaignTable Finish() {
    CampaignTable table{{}, std::move(warnings_)};
    for (auto& [seed, row] : rows_) table.rows.push_back(std::move(row));
    return table;
  }

 private:
  void Add(CampaignRow row, const std::string& place) {
    if (!rows_.empty()) {
      const CampaignRow& first = rows_.begin()->second;
      if (row.scenario != first.scenario || row.control != first.control) {
        throw config::ConfigError(fmt::format("{}is of \"{}\", control {}, the others of \"{}\", control {}",
                                              place, row.scenario, row.control, first.scenario,
                                              first.control));
      }
    }
    const std::uint64_t seed = row.seed;
    const std::string text = ToCsv(row);
    const auto [known, is_new] = rows_.emplace(seed, std::move(row));
    if (!is_new && ToCsv(known->second) != text) {
      throw config::ConfigError(fmt::format(
          "{}seed {} is there already with other results: of another version of the scenario or the program?",
          place, seed));
    }
  }

  std::map<std::uint64_t, CampaignRow> rows_;
  std::vector<std::string> warnings_;
};

}  // namespace

const std::optional<double>& CampaignRow::Value(std::string_view column) const {
  const auto metric = std::find_if(kMetrics.begin(), kMetrics.end(),
                                   [&](const Metric& candidate) { return candidate.column == column; });
  return values.at(static_cast<std::size_t>(metric - kMetrics.begin()));
}

CampaignRow RowOf(std::uint64_t seed, const Summary& summary) {
  CampaignRow row{seed, OneLine(summary.scenario), summary.control, {}};
  Measurement measured(row);
  measured.Set("duration_s", summary.duration_s);
  measured.Set("vehicles", static_cast<double>(summary.vehicles.size()));
  const auto forward_s = Latest(summary, &Settling::forward_s);
  const auto left_s = Latest(summary, &Settling::left_s);
  const auto up_s = Latest(summary, &Settling::up_s);
  measured.Set("settled_s", Later(Later(forward_s, left_s), up_s));
  measured.Set("settled_forward_s", forward_s);
  measured.Set("settled_left_s", left_s);
  measured.Set("settled_up_s", up_s);
  measured.Set("settled_speed_s", Latest(summary, &Settling::speed_s));
  std::optional<double> farthest_m;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.in_formation) farthest_m = std::max(farthest_m.value_or(0), vehicle.greatest_error_m);
  }
  measured.Set("farthest_m", farthest_m);
  const auto nearest =
      std::min_element(summary.approaches.begin(), summary.approaches.end(),
                       [](const Approach& a, const Approach& b) { return a.distance_m < b.distance_m; });
  if (nearest != summary.approaches.end()) {
    measured.Set("least_distance_m", nearest->distance_m);
    measured.Set("least_distance_at_s", nearest->t_s);
  }
  MeasureLinks(summary, measured);
  measured.Set("advisories", CountEvents(summary, "proximity_advisory"));
  measured.Set("cautions", CountEvents(summary, "proximity_caution"));
  measured.Set("warnings", CountEvents(summary, "proximity_warning"));
  return row;
}

std::string CampaignHeader() {
  std::string header = "seed,scenario,control";
  for (const Metric& metric : kMetrics) header += std::string(",") + metric.column;
  return header;
}

std::string ToCsv(const CampaignRow& row) {
  std::string text = fmt::format("{},{},{}", row.seed, Cell(row.scenario), Cell(row.control));
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    text += ',';
    if (row.values[i]) text += fmt::format("{:.{}f}", *row.values[i], kMetrics[i].decimals);
  }
  return text;
}

CampaignTable MergeCampaigns(const std::vector<std::filesystem::path>& files) {
  Merger merger;
  for (const auto& file : files) merger.Add(file);
  return merger.Finish();
}

}  // namespace skein::experiment

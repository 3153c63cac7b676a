#include "cli/drop_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace skein::cli {
namespace {

std::map<std::string, int> CountOutcomes(const DropReport& report) {
  std::map<std::string, int> counts;
  for (const DropRecord& record : report.ledger.records())
    ++counts[record.Outcome(report.limit_s, report.now)];
  return counts;
}

/// Of the cuts that count as found, the least first.
std::vector<double> Detections(const DropReport& report) {
  std::vector<double> detections_s;
  for (const DropRecord& record : report.ledger.records()) {
    const std::string outcome = record.Outcome(report.limit_s, report.now);
    if (record.drop.is_cut() && (outcome == "found" || outcome == "late"))
      detections_s.push_back(*record.detection_s());
  }
  std::sort(detections_s.begin(), detections_s.end());
  return detections_s;
}

double Median(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

}  // namespace

int Failures(const DropReport& report) {
  auto counts = CountOutcomes(report);
  return counts["missed"] + counts["late"];
}

std::string DropSummary(const DropReport& report) {
  auto counts = CountOutcomes(report);
  const auto detections_s = Detections(report);
  std::string text =
      fmt::format("{} drop{} of links: {} found", report.ledger.records().size(),
                  report.ledger.records().size() == 1 ? "" : "s", counts["found"] + counts["late"]);
  if (!detections_s.empty()) {
    text +=
        fmt::format(" (cuts: median {:.2f} s, worst {:.2f} s)", Median(detections_s), detections_s.back());
  }
  text += fmt::format(", {} of them after more than {:g} s; {} missed; {} false\n", counts["late"],
                      report.limit_s, counts["missed"], report.ledger.false_losses().size());
  const std::map<std::string, std::string> others{
      {"short", fmt::format("over before {:g} s and not found by then", report.limit_s)},
      {"degraded", "not cut but worse, and not found lost"},
      {"overlapped", "overlapped with another one, not counted"},
      {"not judged", "of an uplink over which no commands are sent, so that nothing can be found"},
      {"pending", "not long enough under way to be found"}};
  for (const auto& [outcome, words] : others) {
    if (counts[outcome] > 0) text += fmt::format("  {} {}\n", counts[outcome], words);
  }
  return text;
}

std::string DropsAsJson(const DropReport& report) {
  using nlohmann::ordered_json;
  const auto rounded = [](double seconds) { return std::round(1000 * seconds) / 1000; };
  const auto at_s = [&](bus::Utime utime) { return rounded(bus::ToSeconds(utime - report.scenario_start)); };
  const auto optional = [&](const std::optional<double>& seconds) {
    return seconds ? ordered_json(rounded(*seconds)) : ordered_json(nullptr);
  };
  ordered_json drops = ordered_json::array();
  for (const DropRecord& record : report.ledger.records()) {
    drops.push_back(
        {{"number", record.number},
         {"vehicle_id", record.vehicle_id},
         {"callsign", report.callsign(record.vehicle_id)},
         {"direction", Direction(record.drop)},
         {"loss", record.drop.loss},
         {"delay_s", record.drop.delay_s},
         {"at_s", at_s(record.start)},
         {"for_s", rounded(bus::ToSeconds(record.end - record.start))},
         {"outcome", record.Outcome(report.limit_s, report.now)},
         {"detection_s", optional(record.detection_s())},
         {"back_up_after_s",
          optional(record.back ? std::optional(bus::ToSeconds(*record.back - record.end)) : std::nullopt)}});
  }
  ordered_json false_losses = ordered_json::array();
  for (const FalseLoss& loss : report.ledger.false_losses()) {
    false_losses.push_back({{"vehicle_id", loss.vehicle_id},
                            {"callsign", report.callsign(loss.vehicle_id)},
                            {"at_s", at_s(loss.utime)}});
  }
  auto counts = CountOutcomes(report);
  const auto detections_s = Detections(report);
  const bool any = !detections_s.empty();
  ordered_json summary{
      {"drops", report.ledger.records().size()},
      {"found", counts["found"] + counts["late"]},
      {"late", counts["late"]},
      {"missed", counts["missed"]},
      {"false", false_losses.size()},
      {"short", counts["short"]},
      {"degraded", counts["degraded"]},
      {"overlapped", counts["overlapped"]},
      {"not_judged", counts["not judged"]},
      {"pending", counts["pending"]},
      {"limit_s", report.limit_s},
      {"detection_median_s", optional(any ? std::optional(Median(detections_s)) : std::nullopt)},
      {"detection_worst_s", optional(any ? std::optional(detections_s.back()) : std::nullopt)}};
  const ordered_json all{{"drops", drops}, {"false_losses", false_losses}, {"summary", summary}};
  return all.dump(2) + "\n";
}

}  // namespace skein::cli

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "experiment/summary.h"

namespace skein::experiment {
namespace {

constexpr std::size_t kMostLines = 40;

class TextBuilder {
 public:
  explicit TextBuilder(const Summary& summary) : summary_(summary) {
    for (const VehicleSummary& vehicle : summary.vehicles) callsigns_[vehicle.id] = vehicle.callsign;
  }

  std::string Build() {
    Line("{}{}: {} UAV{}, {:.2f} s", summary_.scenario,
         summary_.control.empty() ? "" : ", control " + summary_.control, summary_.vehicles.size(),
         summary_.vehicles.size() == 1 ? "" : "s", summary_.duration_s);
    Vehicles();
    Approaches();
    Drops();
    Events();
    return fmt::to_string(text_);
  }

 private:
  template <typename... Values>
  void Line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_.push_back('\n');
  }

  const std::string& Callsign(int id) const { return callsigns_.at(id); }

  // "178.30", or "-" when it never was.
  static std::string Seconds(const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:.2f}", *seconds) : "-";
  }

  template <typename Items, typename Show>
  void UpToMost(const Items& items, Show show) {
    for (std::size_t i = 0; i < std::min(items.size(), kMostLines); ++i) show(items[i]);
    if (items.size() > kMostLines) Line("  ... and {} more", items.size() - kMostLines);
  }

  void Vehicles() {
    if (summary_.vehicles.empty()) return;
    Line("  Settled for good at [s], within {:g} m of the slot and {:g} m/s of its speed{}:",
         Settling::kPositionM, Settling::kSpeedMS,
         summary_.drops.empty() ? "" : " (up to the first cut of a link)");
    Line("    {:<10}{:>9}{:>9}{:>9}{:>9}{:>16}{:>15}  {}", "", "forward", "left", "up", "speed",
         "speed [m/s]", "farthest [m]", "highest level");
    UpToMost(summary_.vehicles, [this](const VehicleSummary& vehicle) {
      const Settling& settling = vehicle.settling;
      Line("    {:<10}{:>9}{:>9}{:>9}{:>9}{:>16}{:>15}  {}", vehicle.callsign, Seconds(settling.forward_s),
           Seconds(settling.left_s), Seconds(settling.up_s), Seconds(settling.speed_s),
           fmt::format("{:.1f} .. {:.1f}", vehicle.least_speed_m_s, vehicle.greatest_speed_m_s),
           vehicle.in_formation ? fmt::format("{:.1f}", vehicle.greatest_error_m) : "-",
           HighestLevel(vehicle));
    });
  }

  std::string HighestLevel(const VehicleSummary& vehicle) const {
    static constexpr const char* kNames[] = {"clear", "advisory", "caution", "warning"};
    std::string text = fmt::format("{} {}", vehicle.highest_level, kNames[vehicle.highest_level]);
    if (vehicle.highest_level == 0) return text;
    const auto with = callsigns_.find(vehicle.highest_level_with_id);
    if (with != callsigns_.end()) text += " with " + with->second;
    return text + fmt::format(" at {:.2f} s", vehicle.highest_level_s);
  }

  void Approaches() {
    if (summary_.approaches.empty()) return;
    Line("  Least distances:");
    UpToMost(summary_.approaches, [this](const Approach& approach) {
      Line("    {} - {}: {:.1f} m ({:.1f} m horizontally, {:.1f} m vertically) at {:.2f} s",
           Callsign(approach.first_id), Callsign(approach.second_id), approach.distance_m,
           approach.horizontal_m, approach.vertical_m, approach.t_s);
    });
  }

  void Drops() {
    if (summary_.drops.empty()) return;
    Line("  Data links:");
    UpToMost(summary_.drops, [this](const LinkDrop& drop) {
      std::string text = fmt::format("    {} cut {} at {:.2f} s", Callsign(drop.vehicle_id),
                                     drop.uplink && drop.downlink ? "both ways"
                                     : drop.uplink                ? "upwards"
                                                                  : "downwards",
                                     drop.cut_s);
      text += drop.found_s            ? fmt::format(", found lost {:.2f} s later", *drop.found_s - drop.cut_s)
              : drop.told_lost_before ? ", while it was still told lost"
                                      : ", not found lost";
      if (drop.restored_s) text += fmt::format("; restored at {:.2f} s", *drop.restored_s);
      if (drop.seen_up_s && drop.restored_s)
        text += fmt::format(", seen up {:.2f} s later", *drop.seen_up_s - *drop.restored_s);
      if (drop.in_slot_s) text += fmt::format(", in slot again at {:.2f} s", *drop.in_slot_s);
      Line("{}", text);
    });
  }

  void Events() {
    if (summary_.events.empty()) return;
    Line("  Events:");
    UpToMost(summary_.events, [this](const TimedEvent& timed) {
      Line("    {:>8.2f} s  {}: {}", timed.t_s, timed.event.code, timed.event.text);
    });
  }

  const Summary& summary_;
  std::map<int, std::string> callsigns_;
  fmt::memory_buffer text_;
};

}  // namespace

std::string ToText(const Summary& summary) { return TextBuilder(summary).Build(); }

}  // namespace skein::experiment

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/log/flight_states.h"
#include "cli/log/log.h"
#include "cli/text_table.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

// A link that was silent for longer than this leaves a gap, across which nothing is compared.
constexpr double kLongestGap_s = 1;
constexpr std::size_t kMostWaiting = 2'000;
constexpr std::size_t kMostListed = 5;

struct VehicleDiff {
  std::deque<Sample> samples[2];  ///< of either flight, those that still wait for the other one's
  std::int64_t seen[2] = {0, 0};
  double latest_s[2] = {0, 0};
  double heard_s[2] = {0, 0};  ///< for how long, without what was silent
  std::int64_t compared = 0;
  double first_s = 0;  ///< first and last time that was compared
  double last_s = 0;
  double compared_s = 0;          ///< for how long
  std::optional<double> parts_s;  ///< when they are first farther apart than the tolerance
  double parts_m = 0;
  double greatest_m = 0;
  double greatest_s = 0;

  bool in_both() const { return seen[0] > 0 && seen[1] > 0; }
  double longest_heard_s() const { return std::max(heard_s[0], heard_s[1]); }
  /// Compared whenever it was heard; flights do not begin and end at the same moment.
  bool whole() const { return compared > 0 && compared_s >= longest_heard_s() - kLongestGap_s; }
};

class Comparison {
 public:
  explicit Comparison(const LogDiffOptions& options)
      : options_(options), flights_{{options.first, options.flight}, {options.second, options.flight}} {}

  void Run();
  /// Every UAV was compared, and was never too far off.
  bool agrees() const;
  nlohmann::ordered_json ToJson() const;
  std::string ToText() const;
  void TellProblems() {
    for (FlightStates& flight : flights_) flight.source().TellProblems();
  }

 private:
  void Add(int flight, int id, const Sample& sample);
  void Compare(VehicleDiff& vehicle) const;
  /// The other flight has ended before this one.
  bool GoesOn(int flight) const {
    return flights_[flight].now_s() > flights_[1 - flight].now_s() + kLongestGap_s;
  }
  bool is_whole() const;
  std::string Reservation() const;
  std::string Name(int id) const;
  const std::pair<const int, VehicleDiff>* FirstToPart() const;

  const LogDiffOptions& options_;
  FlightStates flights_[2];
  std::map<int, VehicleDiff> vehicles_;
};

void Comparison::Add(int flight, int id, const Sample& sample) {
  VehicleDiff& vehicle = vehicles_[id];
  auto& samples = vehicle.samples[flight];
  // A frozen link repeats its last state, a jittered one overtakes.
  const bool is_first = vehicle.seen[flight]++ == 0;
  if (!is_first && sample.t_s <= vehicle.latest_s[flight]) return;
  const double since_s = is_first ? 0 : sample.t_s - vehicle.latest_s[flight];
  if (since_s <= kLongestGap_s) vehicle.heard_s[flight] += since_s;
  vehicle.latest_s[flight] = sample.t_s;
  samples.push_back(sample);
  // The other flight has no such UAV, or is silent.
  if (samples.size() > kMostWaiting) samples.pop_front();
  Compare(vehicle);
}

/// Compares the second flight's states with where the first one was at their times, between two of its states
/// in a straight line: at 20 Hz, off by a millimetre at most.
void Comparison::Compare(VehicleDiff& vehicle) const {
  auto& [first, second] = vehicle.samples;
  while (!second.empty()) {
    const Sample& sample = second.front();
    while (first.size() >= 2 && first[1].t_s < sample.t_s) first.pop_front();
    if (first.empty()) return;
    if (sample.t_s >= first.front().t_s) {
      if (first.size() < 2) return;
      const Sample& from = first[0];
      const Sample& to = first[1];
      if (to.t_s - from.t_s <= kLongestGap_s) {
        const double share = (sample.t_s - from.t_s) / (to.t_s - from.t_s);
        const double distance_m = (from.place + share * (to.place - from.place) - sample.place).norm();
        if (vehicle.compared++ == 0) vehicle.first_s = vehicle.last_s = sample.t_s;
        const double since_s = sample.t_s - vehicle.last_s;
        if (since_s <= kLongestGap_s) vehicle.compared_s += since_s;
        vehicle.last_s = sample.t_s;
        if (distance_m > vehicle.greatest_m) {
          vehicle.greatest_m = distance_m;
          vehicle.greatest_s = sample.t_s;
        }
        if (distance_m > options_.tolerance_m && !vehicle.parts_s) {
          vehicle.parts_s = sample.t_s;
          vehicle.parts_m = distance_m;
        }
      }
    }
    second.pop_front();
  }
}

void Comparison::Run() {
  Progress progress("comparing");
  bool is_over[2] = {false, false};
  for (;;) {
    // The one that is behind reads on, so that little has to wait; once the other is over, up to its end.
    int flight = flights_[1].now_s() < flights_[0].now_s() ? 1 : 0;
    if (is_over[0] || is_over[1]) {
      flight = is_over[0] ? 1 : 0;
      if (is_over[flight] || GoesOn(flight)) break;
    }
    const bool alone = is_over[1 - flight];
    is_over[flight] = !flights_[flight].ReadOn([&](int id, const Sample& sample) {
      if (!alone || sample.t_s <= flights_[1 - flight].now_s()) Add(flight, id, sample);
    });
    progress.Show(flights_[0].share_read());
    ThrowIfInterrupted();
  }
  for (int flight = 0; flight < 2; ++flight) {
    const FlightPicker& picker = flights_[flight].picker();
    if (picker.flights() < options_.flight) {
      throw config::ConfigError(fmt::format(
          "{}: {}", flights_[flight].source().file(),
          picker.flights() == 0 ? "no FLEET_ROSTER was recorded, so when the flight began is not known"
                                : fmt::format("there is no flight {}; the scenario was started {} times",
                                              options_.flight, picker.flights())));
    }
  }
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.compared > 0) return;
  }
  throw config::ConfigError("the flights have no UAV in common at the same time of their scenarios");
}

bool Comparison::agrees() const {
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.parts_s || vehicle.compared == 0) return false;
  }
  return true;
}

bool Comparison::is_whole() const {
  return !GoesOn(0) && !GoesOn(1) && std::all_of(vehicles_.begin(), vehicles_.end(), [](const auto& item) {
    return item.second.whole();
  });
}

/// What the verdict leaves open, "" when nothing.
std::string Comparison::Reservation() const {
  std::vector<std::string> items;
  for (int flight = 0; flight < 2; ++flight) {
    if (!GoesOn(1 - flight)) continue;
    items.push_back(fmt::format("up to {:.2f} s, where {} ends", flights_[flight].now_s(),
                                flights_[flight].source().file()));
  }
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.whole()) continue;
    if (items.size() > kMostListed) {
      items.emplace_back("...");
      break;
    }
    items.push_back(fmt::format("{} for {:.1f} of {:.1f} s only", Name(id), vehicle.compared_s,
                                vehicle.longest_heard_s()));
  }
  return items.empty() ? "" : fmt::format(" where they can be compared: {}", fmt::join(items, ", "));
}

std::string Comparison::Name(int id) const {
  for (const FlightStates& flight : flights_) {
    const auto found = flight.callsigns().find(id);
    if (found != flight.callsigns().end()) return found->second;
  }
  return "UAV " + std::to_string(id);
}

const std::pair<const int, VehicleDiff>* Comparison::FirstToPart() const {
  const std::pair<const int, VehicleDiff>* first = nullptr;
  for (const auto& item : vehicles_) {
    if (item.second.parts_s && (!first || *item.second.parts_s < *first->second.parts_s)) first = &item;
  }
  return first;
}

nlohmann::ordered_json Comparison::ToJson() const {
  using Json = nlohmann::ordered_json;
  Json json = {{"agree", agrees()}, {"whole", is_whole()}, {"tolerance_m", options_.tolerance_m}};
  json["ends_first"] = GoesOn(1) ? Json("first") : GoesOn(0) ? Json("second") : Json();
  const auto* first = FirstToPart();
  json["parts_s"] = first ? Json(*first->second.parts_s) : Json();
  json["parts_vehicle_id"] = first ? Json(first->first) : Json();
  json["vehicles"] = Json::array();
  for (const auto& [id, vehicle] : vehicles_) {
    Json item = {{"id", id}, {"callsign", Name(id)}, {"compared_states", vehicle.compared}};
    item["only_in"] = vehicle.seen[1] == 0 ? Json("first") : vehicle.seen[0] == 0 ? Json("second") : Json();
    item["compared_s"] = vehicle.compared_s;
    item["heard_s"] = vehicle.longest_heard_s();
    item["from_s"] = vehicle.compared > 0 ? Json(vehicle.first_s) : Json();
    item["to_s"] = vehicle.compared > 0 ? Json(vehicle.last_s) : Json();
    item["parts_s"] = vehicle.parts_s ? Json(*vehicle.parts_s) : Json();
    item["parts_m"] = vehicle.parts_s ? Json(vehicle.parts_m) : Json();
    item["greatest_m"] = vehicle.compared > 0 ? Json(vehicle.greatest_m) : Json();
    item["greatest_s"] = vehicle.compared > 0 ? Json(vehicle.greatest_s) : Json();
    json["vehicles"].push_back(std::move(item));
  }
  return json;
}

std::string Comparison::ToText() const {
  std::string text;
  if (const auto* first = FirstToPart()) {
    text =
        fmt::format("the flights part at {:.2f} s: {} is {:.2f} m off (tolerance {:g} m)\n\n",
                    *first->second.parts_s, Name(first->first), first->second.parts_m, options_.tolerance_m);
  } else if (agrees()) {
    text = fmt::format("the flights agree within {:g} m{}\n\n", options_.tolerance_m, Reservation());
  } else if (std::all_of(vehicles_.begin(), vehicles_.end(),
                         [](const auto& item) { return item.second.in_both(); })) {
    text = "the flights cannot be compared: not every UAV was heard at the same time in both\n\n";
  } else {
    text = "the flights are not of the same UAVs\n\n";
  }
  Table table = {{"UAV", "compared, s", "in all, s", "parts at, s", "by, m", "greatest, m", "at, s"}};
  for (const auto& [id, vehicle] : vehicles_) {
    if (!vehicle.in_both()) {
      table.push_back({Name(id), vehicle.seen[1] == 0 ? "only in the first" : "only in the second", "-", "-",
                       "-", "-", "-"});
      continue;
    }
    const bool any = vehicle.compared > 0;
    table.push_back({Name(id), any ? fmt::format("{:.2f} .. {:.2f}", vehicle.first_s, vehicle.last_s) : "-",
                     fmt::format("{:.1f} of {:.1f}", vehicle.compared_s, vehicle.longest_heard_s()),
                     vehicle.parts_s ? fmt::format("{:.2f}", *vehicle.parts_s) : "-",
                     vehicle.parts_s ? fmt::format("{:.2f}", vehicle.parts_m) : "-",
                     any ? fmt::format("{:.3f}", vehicle.greatest_m) : "-",
                     any ? fmt::format("{:.2f}", vehicle.greatest_s) : "-"});
  }
  return text + Aligned(table, 2);
}

}  // namespace

bool CompareLogs(const LogDiffOptions& options, std::ostream& out) {
  Comparison comparison(options);
  comparison.Run();
  out << (options.json ? comparison.ToJson().dump(1) + '\n' : comparison.ToText());
  comparison.TellProblems();
  return comparison.agrees();
}

}  // namespace skein::cli

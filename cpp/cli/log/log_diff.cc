#include <spdlog/fmt/fmt.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <skein/fleet_state_t.hpp>
#include <vector>

#include "bus/channels.h"
#include "cli/log/flight_picker.h"
#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/text_table.h"
#include "config/scenario.h"
#include "recording/log_listener.h"

namespace skein::cli {
namespace {

/// Where a UAV was at a time of its scenario.
struct Sample {
  double t_s = 0;
  Eigen::Vector3d place{0, 0, 0};  ///< ENU [m]
};

// A link that was silent for longer than this leaves a gap, across which nothing is compared.
constexpr double kLongestGap_s = 1;
constexpr std::size_t kMostWaiting = 2'000;

/// The states of one flight, read bit by bit.
class States {
 public:
  States(const std::string& file, int flight);
  States(const States&) = delete;
  States& operator=(const States&) = delete;

  /// Reads on by so much as there is, to the next state at least; `use` gets each of them. False at the end.
  bool ReadOn(const std::function<void(int id, const Sample& sample)>& use);

  /// The time of the latest state that was read.
  double now_s() const { return now_s_; }
  double share_read() const {
    return static_cast<double>(reader_.bytes_read()) / static_cast<double>(source_.recording().bytes());
  }
  LogSource& source() { return source_; }
  const LogSource& source() const { return source_; }
  const FlightPicker& picker() const { return picker_; }
  const std::map<int, std::string>& callsigns() const { return callsigns_; }

 private:
  LogSource source_;
  FlightPicker picker_;
  recording::RecordingReader reader_;
  recording::LogListener listener_;
  std::map<int, std::string> callsigns_;
  std::vector<std::pair<int, Sample>> read_;
  double now_s_ = -std::numeric_limits<double>::infinity();
};

States::States(const std::string& file, int flight)
    : source_(file), picker_(flight), reader_(source_.recording()) {
  listener_.HearWhole<fleet_roster_t>(bus::channel::kFleetRoster, [this](const fleet_roster_t& roster) {
    if (!picker_.Take(roster)) return;
    for (const vehicle_info_t& vehicle : roster.vehicles) callsigns_[vehicle.id] = vehicle.callsign;
  });
  listener_.Hear<fleet_state_t>(bus::channel::kFleetState, [this](const fleet_state_t& state) {
    if (!picker_.Holds(state.session_id)) return;
    now_s_ = std::max(now_s_, picker_.TimeOf(state.utime));
    for (const vehicle_state_t& vehicle : state.vehicles) {
      read_.push_back(
          {vehicle.id, {picker_.TimeOf(vehicle.utime), {vehicle.east_m, vehicle.north_m, vehicle.up_m}}});
    }
  });
}

bool States::ReadOn(const std::function<void(int id, const Sample& sample)>& use) {
  while (read_.empty()) {
    const auto event = reader_.Next();
    if (!event) {
      source_.Note(reader_);
      return false;
    }
    listener_.Take(*event);
  }
  for (const auto& [id, sample] : read_) use(id, sample);
  read_.clear();
  return true;
}

struct VehicleDiff {
  std::deque<Sample> samples[2];  ///< of either flight, those that still wait for the other one's
  std::int64_t seen[2] = {0, 0};
  std::int64_t compared = 0;
  double first_s = 0;  ///< first and last time that was compared
  double last_s = 0;
  std::optional<double> parts_s;  ///< when they are first farther apart than the tolerance
  double parts_m = 0;
  double greatest_m = 0;
  double greatest_s = 0;
};

class Comparison {
 public:
  explicit Comparison(const LogDiffOptions& options)
      : options_(options), flights_{{options.first, options.flight}, {options.second, options.flight}} {}

  void Run();
  bool agrees() const;
  nlohmann::ordered_json ToJson() const;
  std::string ToText() const;
  void TellRest();

 private:
  void Add(int flight, int id, const Sample& sample);
  void Compare(VehicleDiff& vehicle) const;
  std::string Name(int id) const;
  const std::pair<const int, VehicleDiff>* FirstToPart() const;

  const LogDiffOptions& options_;
  States flights_[2];
  std::map<int, VehicleDiff> vehicles_;
};

void Comparison::Add(int flight, int id, const Sample& sample) {
  VehicleDiff& vehicle = vehicles_[id];
  auto& samples = vehicle.samples[flight];
  // A frozen link repeats its last state, a jittered one overtakes.
  if (vehicle.seen[flight]++ > 0 && !samples.empty() && sample.t_s <= samples.back().t_s) return;
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
        if (vehicle.compared++ == 0) vehicle.first_s = sample.t_s;
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
      if (is_over[flight] || flights_[flight].now_s() > flights_[1 - flight].now_s()) break;
    }
    is_over[flight] =
        !flights_[flight].ReadOn([&](int id, const Sample& sample) { Add(flight, id, sample); });
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
    if (vehicle.parts_s || vehicle.seen[0] == 0 || vehicle.seen[1] == 0) return false;
  }
  return true;
}

std::string Comparison::Name(int id) const {
  for (const States& flight : flights_) {
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
  Json json = {{"agree", agrees()}, {"tolerance_m", options_.tolerance_m}};
  const auto* first = FirstToPart();
  json["parts_s"] = first ? Json(*first->second.parts_s) : Json();
  json["parts_vehicle_id"] = first ? Json(first->first) : Json();
  json["vehicles"] = Json::array();
  for (const auto& [id, vehicle] : vehicles_) {
    Json item = {{"id", id}, {"callsign", Name(id)}, {"compared_states", vehicle.compared}};
    item["only_in"] = vehicle.seen[1] == 0 ? Json("first") : vehicle.seen[0] == 0 ? Json("second") : Json();
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
    text = fmt::format("the flights agree within {:g} m\n\n", options_.tolerance_m);
  } else {
    text = "the flights are not of the same UAVs\n\n";
  }
  Table table = {{"UAV", "compared, s", "parts at, s", "by, m", "greatest, m", "at, s"}};
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.seen[0] == 0 || vehicle.seen[1] == 0) {
      table.push_back(
          {Name(id), vehicle.seen[1] == 0 ? "only in the first" : "only in the second", "-", "-", "-", "-"});
      continue;
    }
    const bool any = vehicle.compared > 0;
    table.push_back({Name(id), any ? fmt::format("{:.2f} .. {:.2f}", vehicle.first_s, vehicle.last_s) : "-",
                     vehicle.parts_s ? fmt::format("{:.2f}", *vehicle.parts_s) : "-",
                     vehicle.parts_s ? fmt::format("{:.2f}", vehicle.parts_m) : "-",
                     any ? fmt::format("{:.3f}", vehicle.greatest_m) : "-",
                     any ? fmt::format("{:.2f}", vehicle.greatest_s) : "-"});
  }
  return text + Aligned(table, 2);
}

void Comparison::TellRest() {
  for (int flight = 0; flight < 2; ++flight) {
    States& states = flights_[flight];
    states.source().TellProblems();
    if (flights_[1 - flight].now_s() > states.now_s() + kLongestGap_s) {
      fmt::print(stderr, "skein: {} ends at {:.2f} s; what the other one has after that is not compared\n",
                 states.source().file(), states.now_s());
    }
  }
}

}  // namespace

bool CompareLogs(const LogDiffOptions& options, std::ostream& out) {
  Comparison comparison(options);
  comparison.Run();
  out << (options.json ? comparison.ToJson().dump(1) + '\n' : comparison.ToText());
  comparison.TellRest();
  return comparison.agrees();
}

}  // namespace skein::cli

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <skein/event_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>

#include "bus/channels.h"
#include "cli/log/flight_picker.h"
#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/log/text.h"
#include "config/scenario.h"
#include "plot/plot.h"
#include "recording/log_listener.h"

namespace skein::cli {
namespace {

// More samples than this are more than a chart has pixels: a long flight is sampled less often.
constexpr std::size_t kMostSamples = 4'000;
constexpr double kFirstPeriod_s = 0.19;  // of FORMATION_STATUS, 0.2 s, with some room

/// Columns of a record that grow together, thinned out as they get long.
class Sampler {
 public:
  explicit Sampler(std::vector<std::vector<double>*> columns) : columns_(std::move(columns)) {}

  /// @param values the first one the time [s].
  void Add(std::initializer_list<double> values) {
    const double t_s = *values.begin();
    std::vector<double>& times = *columns_.front();
    if (!times.empty() && t_s < times.back() + period_s_) return;
    std::size_t column = 0;
    for (const double value : values) columns_[column++]->push_back(value);
    if (times.size() < kMostSamples) return;
    for (auto* column_values : columns_) KeepEverySecond(*column_values);
    period_s_ *= 2;
  }

 private:
  static void KeepEverySecond(std::vector<double>& values) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
  }

  std::vector<std::vector<double>*> columns_;
  double period_s_ = kFirstPeriod_s;
};

struct Curves {
  explicit Curves(int id) {
    record.id = id;
    record.callsign = "UAV " + std::to_string(id);
  }
  Curves(const Curves&) = delete;

  plot::VehicleRecord record;
  Sampler motion{{&record.t_s, &record.east_m, &record.north_m, &record.up_m, &record.speed_m_s}};
  Sampler errors{{&record.slot_t_s, &record.forward_error_m, &record.left_error_m, &record.up_error_m}};
};

class RecordReader {
 public:
  explicit RecordReader(int flight) : picker_(flight) {}
  plot::FlightRecord Read(LogSource& source);

  const std::string& scenario() const { return scenario_; }
  int flights() const { return picker_.flights(); }

 private:
  Curves& Of(int id) { return vehicles_.try_emplace(id, id).first->second; }
  void Hear(const fleet_roster_t& roster);
  void Hear(const fleet_state_t& state);
  void Hear(const formation_status_t& status);
  void Hear(const event_t& event);

  FlightPicker picker_;
  std::string scenario_;
  std::map<int, Curves> vehicles_;
  std::set<double> cuts_s_;      ///< of links, as the simulator tells
  std::set<double> findings_s_;  ///< of lost and restored links, as the monitor tells
};

void RecordReader::Hear(const fleet_roster_t& roster) {
  if (!picker_.Take(roster)) return;
  scenario_ = roster.scenario;
  for (const vehicle_info_t& vehicle : roster.vehicles) Of(vehicle.id).record.callsign = vehicle.callsign;
}

void RecordReader::Hear(const fleet_state_t& state) {
  if (!picker_.Holds(state.session_id)) return;
  for (const vehicle_state_t& vehicle : state.vehicles) {
    Of(vehicle.id)
        .motion.Add({picker_.TimeOf(vehicle.utime), vehicle.east_m, vehicle.north_m, vehicle.up_m,
                     vehicle.speed_m_s});
  }
}

void RecordReader::Hear(const formation_status_t& status) {
  if (!picker_.is_wanted()) return;
  const double t_s = picker_.TimeOf(status.utime);
  for (const slot_status_t& slot : status.slots) {
    Of(slot.vehicle_id).errors.Add({t_s, slot.forward_error_m, slot.left_error_m, slot.up_error_m});
  }
}

void RecordReader::Hear(const event_t& event) {
  if (!picker_.is_wanted()) return;
  const double t_s = picker_.TimeOf(event.utime);
  if (event.code == "link_cut" || event.code == "link_cut_ended") cuts_s_.insert(t_s);
  if (event.code == "link_lost" || event.code == "link_restored") findings_s_.insert(t_s);
}

plot::FlightRecord RecordReader::Read(LogSource& source) {
  namespace channel = bus::channel;
  recording::LogListener listener;
  listener.HearWhole<fleet_roster_t>(channel::kFleetRoster, [this](const auto& roster) { Hear(roster); });
  listener.Hear<fleet_state_t>(channel::kFleetState, [this](const fleet_state_t& state) { Hear(state); });
  listener.Hear<formation_status_t>(channel::kFormationStatus, [this](const auto& status) { Hear(status); });
  listener.Hear<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
  source.ForEach([&](const recording::LogEvent& event, double) {
    listener.Take(event);
    return true;
  });
  plot::FlightRecord flight;
  for (auto& [id, curves] : vehicles_) {
    if (!curves.record.t_s.empty()) flight.vehicles.push_back(curves.record);
  }
  // Real links are cut by nobody who tells; then what the station found is the best there is.
  const auto& changes = cuts_s_.empty() ? findings_s_ : cuts_s_;
  flight.link_changes_s.assign(changes.begin(), changes.end());
  return flight;
}

}  // namespace

void WriteLogPlot(const LogPlotOptions& options, std::ostream& out) {
  LogSource source(options.file);
  Output output(options.output, out, source.parts());
  RecordReader reader(options.flight);
  const plot::FlightRecord flight = reader.Read(source);
  if (flight.vehicles.empty()) {
    throw config::ConfigError(
        reader.flights() == 0
            ? fmt::format("{}: no FLEET_ROSTER was recorded, so when the flight began is not known",
                          options.file)
            : fmt::format("{}: there is no flight {} with UAVs in it; the scenario was started {} times",
                          options.file, options.flight, reader.flights()));
  }
  plot::PlotOptions plot_options;
  plot_options.figure = options.figure == 6 ? plot::Figure::kAssembly : plot::Figure::kFlight;
  plot_options.time_label = "Time of the scenario [s]";
  output.stream() << plot::PlotSvg(reader.scenario().empty() ? Printable(source.name()) : reader.scenario(),
                                   {flight}, plot_options);
  output.Finish();
  source.TellProblems();
  if (reader.flights() > 1) {
    fmt::print(stderr, "skein: {}: the scenario was started {} times; this is flight {} (--flight)\n",
               options.file, reader.flights(), options.flight);
  }
}

}  // namespace skein::cli

#include "cli/log/flight_tracks.h"

#include <algorithm>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <stdexcept>
#include <utility>

#include "bus/channels.h"
#include "bus/conversions.h"
#include "core/path_line.h"
#include "recording/log_listener.h"

namespace skein::cli {
namespace {

constexpr double kSilence_s = 2;
// Thinned in stretches of a minute, so that a long flight takes little memory.
constexpr std::size_t kStretchPoints = 1'200;

config::Origin OriginOf(const fleet_roster_t& roster) {
  return {roster.origin_latitude_deg, roster.origin_longitude_deg, roster.origin_altitude_m};
}

/// The first roster of a recording: whoever joins a flight late has heard UAVs before it.
fleet_roster_t FirstRoster(LogSource& source) {
  std::optional<fleet_roster_t> first;
  recording::LogListener listener;
  listener.HearWhole<fleet_roster_t>(bus::channel::kFleetRoster,
                                     [&](const fleet_roster_t& roster) { first = roster; });
  source.ForEach([&](const recording::LogEvent& event, double) {
    listener.Take(event);
    return !first;
  });
  if (!first) {
    throw config::ConfigError(source.file() +
                              ": no FLEET_ROSTER was recorded, so where its origin lies is not known");
  }
  return *first;
}

class TrackReader {
 public:
  TrackReader(LogSource& source, const LogTracksOptions& options) : source_(source), options_(options) {}
  FlightTracks Read();

 private:
  struct Vehicle {
    std::size_t thinned = 0;  ///< so many points of its piece are thinned already
    bus::Utime last_utime = 0;
    Eigen::Vector3d place{0, 0, 0};
  };

  void Hear(const fleet_roster_t& roster);
  void Hear(const fleet_state_t& state);
  void Hear(const vehicle_state_t& state);
  void Hear(const path_t& path);
  void Hear(const event_t& event);
  void Thin(Vehicle& vehicle, std::vector<TrackPoint>& points) const;
  void EndPieces();
  void Finish();

  /// A path as it came, and along how much of it the leader was seen.
  struct SeenPath {
    path_t message;
    double first_arc_m = 0;
    double last_arc_m = 0;
  };
  static std::vector<Eigen::Vector3d> LineOf(const SeenPath& seen);

  LogSource& source_;
  const LogTracksOptions& options_;
  FlightTracks tracks_;
  bool is_in_window_ = false;
  config::Origin origin_;
  std::int64_t session_id_ = -1;
  std::map<int, Vehicle> vehicles_;
  std::map<int, std::string> formation_names_;
  std::map<int, formation_status_t> statuses_;
  std::map<int, std::size_t> path_of_;  ///< places in tracks_.paths, by formation
  std::vector<SeenPath> seen_paths_;    ///< as tracks_.paths
};

void TrackReader::Hear(const fleet_roster_t& roster) {
  for (const vehicle_info_t& vehicle : roster.vehicles) {
    VehicleTrack& track = tracks_.vehicles[vehicle.id];
    track.id = vehicle.id;
    track.callsign = vehicle.callsign;
  }
  if (tracks_.scenario.empty()) tracks_.scenario = roster.scenario;
  if (roster.session_id == session_id_) return;
  EndPieces();
  session_id_ = roster.session_id;
  origin_ = OriginOf(roster);
  path_of_.clear();
  statuses_.clear();
}

void TrackReader::Hear(const fleet_state_t& state) {
  // What was still under way from the flight before is not part of this one.
  if (state.session_id != session_id_) return;
  for (const vehicle_state_t& vehicle : state.vehicles) Hear(vehicle);
}

void TrackReader::Hear(const vehicle_state_t& state) {
  if (tracks_.base_utime == 0) tracks_.base_utime = state.utime;
  const bool is_first = !vehicles_.contains(state.id);
  Vehicle& vehicle = vehicles_[state.id];
  // A frozen link repeats its last state, a jittered one overtakes.
  if (!is_first && state.utime <= vehicle.last_utime) return;
  const bool is_new_piece = is_first || state.utime > vehicle.last_utime + bus::ToUtime(kSilence_s);
  vehicle.last_utime = state.utime;
  vehicle.place = {state.east_m, state.north_m, state.up_m};
  if (!is_in_window_) {
    vehicle.last_utime = 0;  // what comes first within the window begins a piece
    return;
  }
  VehicleTrack& track = tracks_.vehicles[state.id];
  track.id = state.id;
  if (is_new_piece) {
    track.pieces.push_back({origin_, {}});
    vehicle.thinned = 0;
  }
  auto& points = track.pieces.back().points;
  points.push_back({bus::ToSeconds(state.utime - tracks_.base_utime), vehicle.place});
  if (points.size() >= vehicle.thinned + kStretchPoints) Thin(vehicle, points);
}

void TrackReader::Thin(Vehicle& vehicle, std::vector<TrackPoint>& points) const {
  if (options_.tolerance_m > 0) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(vehicle.thinned);
    const auto thinned = Thinned(std::vector<TrackPoint>(begin, points.end()), options_.tolerance_m);
    points.erase(begin, points.end());
    points.insert(points.end(), thinned.begin(), thinned.end());
  }
  vehicle.thinned = points.size() - 1;
}

void TrackReader::Hear(const path_t& message) {
  if (!is_in_window_) return;
  const auto status = statuses_.find(message.formation_id);
  const bool is_flown = status != statuses_.end();
  const auto known = path_of_.find(message.formation_id);
  if (known != path_of_.end()) {
    FormationPath& path = tracks_.paths[known->second];
    path.last_utime = message.utime;
    if (path.revision == message.path_revision) {
      if (is_flown) seen_paths_[known->second].last_arc_m = status->second.leader_arc_m;
      return;
    }
  }
  FormationPath path;
  path.formation_id = message.formation_id;
  path.formation_name = formation_names_[message.formation_id];
  path.revision = message.path_revision;
  path.first_utime = path.last_utime = message.utime;
  path.origin = origin_;
  path_of_[message.formation_id] = tracks_.paths.size();
  tracks_.paths.push_back(std::move(path));
  const double start_arc_m = is_flown ? status->second.leader_arc_m : message.start_arc_m;
  seen_paths_.push_back({message, start_arc_m, start_arc_m});
}

/// As the map of the page draws it; a path that goes straight on for good, as far as it was flown.
std::vector<Eigen::Vector3d> TrackReader::LineOf(const SeenPath& seen) {
  try {
    const Path path = bus::ToPath(seen.message);
    const DrawnStretch stretch = StretchToDraw(path, seen.first_arc_m, seen.message.waypoints.empty());
    const double to_arc_m = stretch.endless ? std::max(seen.first_arc_m, seen.last_arc_m) : stretch.to_arc_m;
    return SampleLine(path, stretch.from_arc_m, to_arc_m);
  } catch (const std::invalid_argument&) {
    return {};  // no path, whoever sent it
  }
}

void TrackReader::Hear(const event_t& event) {
  if (!is_in_window_) return;
  PlacedEvent placed{event, origin_, {}};
  const auto vehicle = vehicles_.find(event.vehicle_id);
  const auto status = statuses_.find(event.formation_id);
  if (vehicle != vehicles_.end()) {
    placed.place = vehicle->second.place;
  } else if (status != statuses_.end()) {
    const formation_status_t& leader = status->second;
    placed.place = Eigen::Vector3d(leader.leader_east_m, leader.leader_north_m, leader.leader_up_m);
  }
  tracks_.events.push_back(std::move(placed));
}

void TrackReader::EndPieces() {
  for (auto& [id, vehicle] : vehicles_) {
    auto& pieces = tracks_.vehicles[id].pieces;
    if (!pieces.empty()) Thin(vehicle, pieces.back().points);
  }
  vehicles_.clear();
}

void TrackReader::Finish() {
  EndPieces();
  for (std::size_t i = 0; i < tracks_.paths.size(); ++i) tracks_.paths[i].line = LineOf(seen_paths_[i]);
  std::erase_if(tracks_.paths, [](const FormationPath& path) { return path.line.size() < 2; });
  std::erase_if(tracks_.vehicles, [](const auto& item) { return item.second.pieces.empty(); });
  for (auto& [id, track] : tracks_.vehicles) {
    if (track.callsign.empty()) track.callsign = "UAV " + std::to_string(id);
  }
  if (tracks_.vehicles.empty()) {
    throw config::ConfigError(source_.file() + ": no UAV was heard in this time");
  }
}

FlightTracks TrackReader::Read() {
  Hear(FirstRoster(source_));
  namespace channel = bus::channel;
  recording::LogListener listener;
  listener.HearWhole<fleet_roster_t>(channel::kFleetRoster, [this](const auto& roster) { Hear(roster); });
  listener.Hear<fleet_state_t>(channel::kFleetState, [this](const fleet_state_t& state) { Hear(state); });
  listener.Hear<path_t>(channel::kPath, [this](const path_t& path) { Hear(path); });
  listener.Hear<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
  listener.Hear<formation_t>(channel::kFormation, [this](const formation_t& formation) {
    formation_names_[formation.formation_id] = formation.name;
  });
  listener.Hear<formation_status_t>(channel::kFormationStatus, [this](const formation_status_t& status) {
    statuses_[status.formation_id] = status;
  });
  source_.ForEach([&](const recording::LogEvent& event, double t_s) {
    is_in_window_ = options_.window.Holds(t_s);
    if (options_.window.IsPast(t_s)) return false;
    listener.Take(event);
    return true;
  });
  Finish();
  return std::move(tracks_);
}

}  // namespace

FlightTracks ReadTracks(LogSource& source, const LogTracksOptions& options) {
  return TrackReader(source, options).Read();
}

}  // namespace skein::cli

#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <skein/event_t.hpp>
#include <string>
#include <vector>

#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "config/scenario.h"
#include "core/track.h"

namespace skein::cli {

/// A stretch that was flown in one go: no silence of more than 2 s, no new start of the scenario.
struct TrackPiece {
  config::Origin origin;
  std::vector<TrackPoint> points;  ///< times since FlightTracks::base_utime
};

struct VehicleTrack {
  int id = 0;
  std::string callsign;
  std::vector<TrackPiece> pieces;
};

/// A path of a formation, from when on and until when it was the one.
struct FormationPath {
  int formation_id = 0;
  std::string formation_name;
  std::int64_t revision = 0;
  bus::Utime first_utime = 0;
  bus::Utime last_utime = 0;
  config::Origin origin;
  std::vector<Eigen::Vector3d> line;  ///< east, north, up [m]
};

/// An EVENT, and where the UAV or the formation that it is about was then.
struct PlacedEvent {
  event_t event;
  config::Origin origin;
  std::optional<Eigen::Vector3d> place;  ///< east, north, up [m]
};

/// What a map shows of a flight.
struct FlightTracks {
  std::string scenario;
  bus::Utime base_utime = 0;
  std::map<int, VehicleTrack> vehicles;
  std::vector<FormationPath> paths;
  std::vector<PlacedEvent> events;

  bus::Utime UtimeOf(const TrackPoint& point) const { return base_utime + bus::ToUtime(point.t_s); }
};

/// Reads them. Throws config::ConfigError when no roster was recorded, without which nobody knows where on
/// earth the fleet is, or no UAV was heard in the time of the window.
FlightTracks ReadTracks(LogSource& source, const LogTracksOptions& options);

}  // namespace skein::cli

#pragma once

#include <functional>
#include <optional>
#include <skein/formation_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/vehicle_info_t.hpp>
#include <string>
#include <vector>

#include "bus/executor.h"
#include "controller/controller_state.h"
#include "core/path.h"
#include "core/proximity.h"
#include "core/track.h"
#include "experiment/preview_watch.h"

namespace skein::experiment {

/// A flight at one moment, as the station knows it.
struct FlightPicture {
  struct Vehicle {
    vehicle_info_t info;
    std::optional<VehicleState> state;  ///< at the picture's time; none: it was never heard
    bool lost = false;                  ///< the data link, in either direction
  };
  bus::Utime utime = 0;
  std::vector<Vehicle> vehicles;
  /// As the controller tells them on the bus.
  std::vector<controller::FormationState> formations;
  /// Of the scenario; what is on the bus does not tell them.
  double ceiling_m = 1e9;
  ProximityLimits strangers = StrangerLimits();
};

struct PreviewOptions {
  double longest_s = 300;      ///< of the flight
  std::function<bool()> stop;  ///< asked after each control step; true ends the flight early
};

/// What became of a change that was flown ahead. Times are seconds since the change.
struct Preview {
  bool ok = false;     ///< the controller has taken the change; nothing else is known when it has not
  std::string reason;  ///< why not, or the controller's remark

  double duration_s = 0;                  ///< that was flown
  bool complete = false;                  ///< false: the flight was ended before it came to its end
  std::vector<CylinderApproach> nearest;  ///< the ten pairs that come nearest to their cylinder, worst first
  std::optional<double> settle_s;         ///< from then on all are in their slots; none: not in that time
  std::vector<BindingLimit> limits;       ///< of members, what kept them out of their slots
  std::vector<Track> tracks;              ///< of members, old and new, and of all in `nearest`
};

/// One leg of a path as it is flown.
struct FlownLeg {
  std::optional<std::size_t> from;  ///< index of a waypoint; none: where the leader is
  std::size_t to = 0;
  double length_m = 0;
  double time_s = 0;
  double course_rad = 0;  ///< from the one point straight to the other
};

struct PathPreview {
  std::vector<PathProblem> problems;  ///< all that is against it
  std::optional<Path> path;           ///< the way and the path, as the controller flies it
  double leader_arc_m = 0;            ///< where on it the leader is
  std::vector<FlownLeg> legs;         ///< of a closed path, the last one leads to where the first one led
  Preview flight;                     ///< when that was wanted
};

/// Flies a change of a formation ahead from a picture of the flight, with the simulator and the controller of
/// flight-experiment and by the very command that would be sent: until all have been in their slots for 20 s.
/// Formations that are not concerned fly on. Links are perfect; a UAV whose link is lost stays lost and flies
/// on level, as the monitor supposes. What the laws' integrals have learnt is not in the picture and begins
/// at nothing.
Preview PreviewFormation(const FlightPicture& picture, const formation_t& formation,
                         const PreviewOptions& options);

/// The same for a new path. Flown once, until the last slot is at its end or once round; not at all when
/// `options.longest_s` is 0.
PathPreview PreviewPath(const FlightPicture& picture, const path_command_t& path,
                        const PreviewOptions& options);

}  // namespace skein::experiment

#pragma once

#include <map>
#include <skein/event_t.hpp>
#include <skein/vehicle_state_t.hpp>
#include <string>
#include <vector>

namespace skein::testing {

struct StateAt {
  double t_s = 0;  ///< since tick 0 of the simulator
  vehicle_state_t state;
};

struct EventAt {
  double t_s = 0;
  event_t event;
};

/// What a recording holds of a flight.
struct FlightLog {
  std::map<int, std::vector<StateAt>> curves;  ///< by vehicle id, in order of time
  std::vector<EventAt> events;                 ///< in the order they came in
};

/// Reads what lcm-logger or flight-experiment --log wrote.
FlightLog ReadFlightLog(const std::string& file);

/// The greatest distance of two curves at the same times, up to `end_s` [m]. Infinite if one does not cover
/// that time.
double GreatestDistance(const std::vector<StateAt>& reference, const std::vector<StateAt>& other,
                        double end_s);

}  // namespace skein::testing

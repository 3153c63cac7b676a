#include "cli/log/flight_states.h"

#include <algorithm>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>

#include "bus/channels.h"

namespace skein::cli {

FlightStates::FlightStates(const std::string& file, int flight)
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

bool FlightStates::ReadOn(const std::function<void(int id, const Sample& sample)>& use) {
  while (read_.empty()) {
    // A long recording may have no state at all, or none of the flight.
    ThrowIfInterrupted();
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

}  // namespace skein::cli

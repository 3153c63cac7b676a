#pragma once

#include <cstdint>
#include <optional>
#include <skein/link_command_t.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bus/executor.h"
#include "simulator/simulated_vehicle.h"

namespace skein::simulator {

/// What was asked of a data link, and when. The links of a flight follow from its scenario and these.
struct LinkOrder {
  bus::Utime utime = 0;
  link_command_t command;
};

/// All that a simulator needs to go on with a flight: but for what is under way on links that bring messages
/// late, which is lost.
struct FlightState {
  std::string started_with;  ///< the scenario file on the command line
  std::string scenario;      ///< the file that is flown, which may be another by now
  std::uint64_t seed = 0;
  bus::Utime start_utime = 0;
  std::int64_t tick = 0;
  std::vector<LinkOrder> link_orders;
  std::vector<SimulatedVehicle::Memory> vehicles;  ///< in the order of the scenario
};

/// As a bus::StateFile keeps it.
std::string Encode(const FlightState& state);

/// None when the bytes hold none.
std::optional<FlightState> DecodeFlightState(std::string_view bytes);

}  // namespace skein::simulator

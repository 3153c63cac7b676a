#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/link_command_t.hpp>
#include <skein/payload_command_t.hpp>
#include <skein/simulation_command_t.hpp>
#include <unordered_map>
#include <vector>

#include "bus/bus.h"
#include "bus/chunks.h"
#include "bus/command_inbox.h"
#include "bus/events.h"
#include "bus/state_file.h"
#include "config/scenario.h"
#include "core/fleet_motion.h"
#include "simulator/flight_state.h"
#include "simulator/link_schedule.h"
#include "simulator/simulated_vehicle.h"

namespace skein::simulator {

struct SimulatorOptions {
  config::Scenario scenario;
  std::uint64_t seed = 1;  ///< of all lossy and jittered links
  /// Where the flight is kept, so that a simulator that died goes on with it; empty: nowhere.
  std::filesystem::path state_file{};
};

/// A fleet of UAVs with their data links, and the gateway that puts them on the bus. Tick n stands for
/// start_utime() + n * kPeriod; at each one the UAVs fly on, then the links change as planned, then the UAVs
/// report. CMD_SIMULATION begins a new flight at the next tick, which is its tick 0: to everybody else it is
/// as if the process had been started again.
class FleetSimulatorNode {
 public:
  static constexpr bus::Utime kPeriod = 50'000;
  /// A flight that was kept longer ago than this is not gone on with.
  static constexpr bus::Utime kLongestGap = 60 * bus::kSecond;

  /// The first tick is now. @param bus outlives the node.
  FleetSimulatorNode(bus::Bus& bus, const SimulatorOptions& options);
  FleetSimulatorNode(const FleetSimulatorNode&) = delete;
  FleetSimulatorNode& operator=(const FleetSimulatorNode&) = delete;

  bus::Utime start_utime() const { return flight_->start_utime; }
  /// The last one that was flown; -1 before the first.
  std::int64_t tick() const { return flight_->tick; }
  /// The true fleet, in the order of the scenario.
  const std::vector<SimulatedVehicle>& fleet() const { return flight_->fleet; }

 private:
  /// All that a new flight begins without.
  struct Flight {
    Flight(const SimulatorOptions& options, bus::Utime start_utime, bus::Events& events);
    /// Goes on with one that was kept; of the same scenario.
    void Recall(const FlightState& state);

    bus::Utime start_utime;  ///< also the session on FLEET_ROSTER and FLEET_STATE
    std::int64_t tick = -1;
    std::vector<SimulatedVehicle> fleet;
    FleetMotion motion;  ///< of the fleet, in the same order
    std::unordered_map<int, std::size_t> index;
    bool tells = true;  ///< of changes to links
    LinkSchedule links;
    std::vector<LinkOrder> link_orders;  ///< that operators have given
    std::vector<fleet_roster_t> roster;  ///< in chunks
    std::size_t roster_sent;             ///< how many of them in this round
    std::int64_t roster_due = 0;         ///< tick of the next round
  };

  static bus::Utime NextTick(bus::Utime now);
  std::unique_ptr<Flight> StartOrGoOn();
  FlightState StateNow() const;
  void SaveNow();
  void Tick();
  void Fly(std::int64_t tick);
  void PublishRoster(bus::Burst& burst);
  void PublishState(bus::Burst& burst);
  void Command(const fleet_command_t& command);
  bus::Answer SetLink(const link_command_t& command);
  bus::Answer SwitchPayload(const payload_command_t& command);
  bus::Answer StartAnew(const simulation_command_t& command);
  SimulatedVehicle* Find(int vehicle_id);

  bus::Bus& bus_;
  SimulatorOptions options_;
  bus::Events events_;
  bus::StateFile state_file_;
  bus::CommandInbox inbox_;
  std::string started_with_;  ///< the scenario's file
  std::unique_ptr<Flight> flight_;
  bus::Utime commanded_ = 0;  ///< by the session below, last
  std::int64_t command_session_id_ = 0;
  std::int64_t command_request_id_ = 0;
};

}  // namespace skein::simulator

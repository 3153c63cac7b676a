#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_command_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/path_command_t.hpp>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "bus/chunks.h"
#include "bus/command_inbox.h"
#include "bus/events.h"
#include "bus/state_file.h"
#include "config/scenario.h"
#include "controller/controller_state.h"
#include "controller/fleet_picture.h"
#include "controller/formation_flight.h"

namespace skein::controller {

struct ControllerOptions {
  /// Formations, paths and airspace to start with; none: formations come by CMD_FORMATION.
  std::optional<config::Scenario> scenario;
  /// The scenario of a fleet that has started anew, by the name in its roster; none: not found. Empty:
  /// `scenario` is for every flight.
  std::function<std::optional<config::Scenario>(const std::string& name)> find_scenario{};
  /// FORMATION_STATUS of each formation goes out every so many ticks of FLEET_STATE; 0: as StatusEveryTicks
  /// says.
  int status_every_ticks = 0;
  /// Where the state of all formations is kept, so that a controller that died picks up where it was; empty:
  /// nowhere.
  std::filesystem::path state_file;
  /// Formations in flight to go on with, instead of those of the state file and of the scenario.
  std::optional<ControllerState> state;
};

/// Every how many ticks the status of each of so many formations goes out: 4 (5 Hz) up to 20 formations, for
/// more of them less often, for 100 and more 20 (1 Hz). All at 5 Hz would be half of the messages on the bus,
/// and lcm-logger lets 30 wait.
int StatusEveryTicks(std::size_t formations);

/// formation-controller: wakes on each complete tick of FLEET_STATE and answers with CMD_FLEET.
class FormationControllerNode {
 public:
  FormationControllerNode(bus::Bus& bus, const ControllerOptions& options);

  const std::map<int, FormationFlight>& flights() const { return flights_; }
  /// What CMD_PATH would be answered and flown now; none when there is no such formation.
  std::optional<PathPlan> PlanPath(const path_command_t& command) const;

 private:
  // What the bus brings (controller_node.cc).
  void OnRoster(const fleet_roster_t& roster);
  void OnFleetState(const fleet_state_t& state);
  void OnLinkStatus(const link_status_t& status);

  // What starts and ends a flight (formation_start.cc).
  void TakeScenario(const std::string& name, bool again);
  void StartScenario();
  void StartWaiting(std::size_t most);
  void StartFromScenario(const config::FormationConfig& config);
  std::string StartFlight(const config::FormationConfig& config);
  std::optional<VirtualLeader> LeaderOverFleet(const std::vector<Slot>& slots, std::string& reason) const;
  bool RestoreState();
  std::optional<ControllerState> ReadState();
  /// None while there is nothing to be kept yet.
  std::optional<ControllerState> StateNow() const;
  /// Every second.
  void SaveState();
  /// What an operator has been promised: on the disk when it returns.
  void SaveStateNow();

  // What operators ask for (operator_commands.cc).
  bus::Answer OnFormationCommand(const formation_command_t& command);
  bus::Answer OnPathCommand(const path_command_t& command);
  std::string WhyNotYet() const;
  bus::Answer Apply(const formation_t& message);
  std::string CloseSlots(const config::FormationConfig& config) const;
  std::string WhyNot(const config::FormationConfig& config) const;

  // What goes out (controller_node.cc).
  void SendCommands(const std::vector<FlightCommand>& commands, bus::Burst& burst);
  void SendFormation(const FormationFlight& flight);
  void SendFormation(const FormationFlight& flight, bus::Burst& burst);
  void RepeatFormations();
  void SendStatuses(bus::Burst& burst);
  void Tell(const FormationFlight& flight, const FlightEvent& event);
  std::vector<FlightCommand> HoldTheRest();

  /// Parts of a second; FORMATION and PATH of each formation go out in one of them.
  static constexpr std::size_t kRepeatParts = 20;
  /// Planning a path takes up to 20 ms, while nobody reads the bus: so many formations of a scenario are
  /// started at once, and so many more in each part of a second.
  static constexpr std::size_t kStartAtOnce = 10;
  static constexpr std::size_t kStartInAPart = 2;

  bus::Bus& bus_;
  ControllerOptions options_;
  bus::Events events_;
  bus::StateFile state_file_;
  bus::CommandInbox inbox_;

  FleetPicture fleet_;
  std::map<int, FormationFlight> flights_;
  std::deque<config::FormationConfig> waiting_;   ///< formations of the scenario that are not started yet
  std::map<int, VehicleState> held_;              ///< UAVs that are in no formation, and what they hold
  bus::Utime start_utime_ = 0;                    ///< t = 0 of the scenario; 0: no roster yet
  std::int64_t fleet_session_id_ = 0;             ///< of FLEET_STATE
  std::optional<fleet_roster_t> unflown_roster_;  ///< of a session whose FLEET_STATE has not been heard
  bus::Utime tick_utime_ = 0;
  bus::Utime clock_ahead_ = 0;  ///< of the fleet's clock: the most that a tick has been ahead of ours
  std::int64_t tick_ = 0;
  std::int64_t ticks_heard_ = 0;
  std::size_t repeat_part_ = 0;  ///< of kRepeatParts, the next
  std::int64_t request_id_ = 0;
  std::int64_t sequence_ = 0;
};

}  // namespace skein::controller

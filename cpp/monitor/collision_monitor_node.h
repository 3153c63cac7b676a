#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "bus/events.h"
#include "core/alert_levels.h"
#include "monitor/alarm_desk.h"
#include "monitor/clock_watch.h"
#include "monitor/held_up.h"
#include "monitor/link_alarms.h"
#include "monitor/link_memory.h"
#include "monitor/membership.h"
#include "monitor/silence_watch.h"
#include "monitor/watched_uav.h"

namespace skein::monitor {

struct CollisionMonitorOptions {
  int rate_hz = 1;                               ///< of PROXIMITY, 1 .. 10
  std::string scenario;                          ///< its name, "" when there is none
  ProximityLimits strangers = StrangerLimits();  ///< between UAVs that are not in one formation
  std::vector<KnownFormation> formations;        ///< until FORMATION says more
  /// The options of a fleet that has started anew, by the scenario's name in its roster; none: not found.
  /// Empty: these are for every flight.
  std::function<std::optional<CollisionMonitorOptions>(const std::string& name)> find_options{};
  /// Where the alarms are kept, and when each UAV was last heard, so that a monitor that died goes on with
  /// them; empty: nowhere.
  std::filesystem::path state_file{};
  LinkTimes link_times;
  UncertaintyGrowth uncertainty;
};
/// Throws std::invalid_argument naming the field and the reason.
void Check(const CollisionMonitorOptions& options);

/// Hears FLEET_ROSTER, FLEET_STATE, CMD_FLEET, FORMATION, HEARTBEAT, CMD_ALARM. Sends PROXIMITY, LINK_STATUS,
/// ALARMS, EVENT, ACK.
///
/// Watched is every UAV of the roster, and every other one for as long as it is heard. One that was never
/// heard has no place: it is in LINK_STATUS (unknown for 5 s, lost after that), but not in PROXIMITY. One
/// that is lost stays in both, dead-reckoned.
class CollisionMonitorNode {
 public:
  CollisionMonitorNode(bus::Bus& bus, const CollisionMonitorOptions& options);

 private:
  void HearRoster(const fleet_roster_t& roster, int missing_chunks);
  void StartFlight(const fleet_roster_t& roster);
  bool TakeScenario(const std::string& name, bool again);
  void HearState(const fleet_state_t& state);
  /// Begins to watch it if it is not watched yet. @param session_id of the message that names it.
  WatchedUav& Watch(int id, const std::string& callsign, bool in_roster, std::int64_t session_id);
  void HearCommands(const fleet_command_t& commands);

  void CheckLinks();
  void PublishLinks(bus::Utime now);
  void Sweep();
  void PublishProximity(bus::Utime now);

  void RaiseOrEnd(const AlertChange& change, const Notice& notice);

  std::vector<Traffic> Locate(bus::Utime now) const;
  Notice Describe(const AlertChange& change, const std::vector<Traffic>& fleet) const;
  std::string CallsignOf(int id) const;
  /// The worst first, and no more at once than people can read and a socket buffer can take.
  void Tell(std::vector<Notice> notices);

  bus::Bus& bus_;
  bus::Events events_;
  AlarmDesk alarms_;
  LinkMemory link_memory_;
  LinkAlarms link_alarms_;
  SilenceWatch silence_;
  ClockWatch clocks_;
  CollisionMonitorOptions options_;
  Membership membership_;
  ProximityIndex index_;  ///< of the sweep that is under way
  AlertLevels levels_;
  std::map<int, WatchedUav> uavs_;
  bus::Utime start_utime_ = 0;         ///< of the flight; 0: no roster yet
  bus::Utime levels_from_;             ///< by then every FORMATION has been heard
  std::int64_t fleet_session_id_ = 0;  ///< of FLEET_STATE
  std::int64_t fleet_tick_ = 0;
  std::int64_t sweep_ = 0;
  std::int64_t link_sequence_ = 0;
  bus::Utime links_sent_ = 0;
  HeldUp held_up_{bus::kSecond / 2};  // ten FLEET_STATE
};

}  // namespace skein::monitor

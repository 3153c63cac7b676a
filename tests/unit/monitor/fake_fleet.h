#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/proximity_t.hpp>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/simulated_executor.h"

namespace skein::monitor::testing {

/// Flies straight on; its faults are set by hand.
struct FakeUav {
  VehicleState start;
  double delay_s = 0;      ///< of its telemetry
  double clock_off_s = 0;  ///< its stamps are so far ahead
  bool in_roster = true;
  bool downlink = true;
  bool uplink = true;
  bool frozen = false;  ///< repeats the state that it had when this was set
  std::optional<vehicle_state_t> last;
  std::int64_t obeyed = 0;
};

/// Simulator and controller as far as the monitor hears them: FLEET_STATE and CMD_FLEET at 20 Hz,
/// FLEET_ROSTER and FORMATION at 1 Hz.
class FakeFleet {
 public:
  explicit FakeFleet(bus::Bus& bus) : bus_(bus), start_(bus.executor().Now()) {
    bus.executor().Every(kTick, [this] { Tick(); });
  }

  std::map<int, FakeUav> uavs;
  std::map<int, std::vector<int>> formations;  ///< id -> members
  std::string scenario;
  bus::Utime start_utime = 0;  ///< of the flight; 0: that of this
  double clock_ahead_s = 0;    ///< of the monitor's
  bool commands = true;
  bool telemetry = true;
  bool roster = true;

  static constexpr std::int64_t kSession = 1;
  std::int64_t session = kSession;  ///< of FLEET_STATE

  /// Adds a UAV that flies along a course.
  FakeUav& Add(int id, double east_m, double north_m, double up_m, double speed_m_s = 50,
               double course_rad = 0) {
    FakeUav& uav = uavs[id];
    uav.start = {east_m, north_m, up_m, speed_m_s, course_rad, 0};
    return uav;
  }

 private:
  static constexpr bus::Utime kTick = 50'000;

  VehicleState At(const FakeUav& uav, bus::Utime utime) const {
    VehicleState state = uav.start;
    const double t = bus::ToSeconds(utime - start_);
    state.east_m += t * state.speed_m_s * std::cos(state.course_rad);
    state.north_m += t * state.speed_m_s * std::sin(state.course_rad);
    return state;
  }

  void Tick() {
    const bus::Utime now = bus_.executor().Now() + bus::ToUtime(clock_ahead_s);
    if (telemetry) {
      fleet_state_t states;
      states.utime = now;
      states.session_id = session;
      states.tick = ++tick_;
      for (auto& [id, uav] : uavs) {
        if (!uav.downlink) continue;
        if (!uav.frozen || !uav.last) {
          const bus::Utime utime = now - bus::ToUtime(uav.delay_s);
          uav.last = bus::ToMessage(At(uav, utime));
          uav.last->utime = utime + bus::ToUtime(uav.clock_off_s);
          uav.last->id = id;
          uav.last->command_session_id = uav.obeyed > 0 ? 9 : 0;
          uav.last->command_sequence = uav.obeyed;
        }
        states.vehicles.push_back(*uav.last);
      }
      bus::PublishChunks(bus_, bus::channel::kFleetState, states);
    }
    if (tick_ % 20 == 1) Repeat(now);
    if (commands) Command(now);
  }

  void Command(bus::Utime now) {
    fleet_command_t command;
    command.utime = now;
    command.session_id = 9;
    command.to_session_id = session;
    command.request_id = command.state_tick = tick_;
    for (auto& [id, uav] : uavs) {
      vehicle_command_t& one = command.commands.emplace_back();
      one.id = id;
      one.sequence = tick_;
      one.setpoint_speed_m_s = 50;
      if (uav.uplink) uav.obeyed = tick_;
    }
    bus::PublishChunks(bus_, bus::channel::kCmdFleet, command);
  }

  void Repeat(bus::Utime now) {
    fleet_roster_t listed;
    listed.utime = now;
    listed.session_id = session;
    listed.scenario = scenario;
    listed.start_utime = start_utime == 0 ? start_ : start_utime;
    for (const auto& [id, uav] : uavs) {
      if (uav.in_roster)
        listed.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel{}, true));
    }
    if (roster) bus::PublishChunks(bus_, bus::channel::kFleetRoster, listed);
    if (!commands) return;
    for (const auto& [id, members] : formations) {
      formation_t formation;
      formation.utime = now;
      formation.formation_id = id;
      formation.control = "skein";
      formation.shape = "custom";
      bus::SetProximityLimits(formation, ProximityLimits{});
      std::vector<Slot> slots;
      for (const int member : members) slots.push_back({member, {}});
      bus::SetSlots(formation, slots);
      bus_.Publish(bus::channel::kFormation, formation);
    }
  }

  bus::Bus& bus_;
  bus::Utime start_;
  std::int64_t tick_ = 0;
};

/// All that the monitor says.
class Listener {
 public:
  explicit Listener(bus::Bus& bus) {
    bus.Subscribe<event_t>(bus::channel::kEvent, [this](const event_t& event) { events.push_back(event); });
    bus::SubscribeChunks<proximity_t>(bus, bus::channel::kProximity, [this](const proximity_t& message, int) {
      proximity.push_back(message);
    });
    bus::SubscribeChunks<link_status_t>(
        bus, bus::channel::kLinkStatus,
        [this](const link_status_t& message, int) { links.push_back(message); });
  }

  std::vector<event_t> events;
  std::vector<proximity_t> proximity;
  std::vector<link_status_t> links;

  /// Of the last LINK_STATUS and PROXIMITY; none: not in it.
  std::optional<vehicle_link_t> Link(int id) const { return Find(links.back().links, id); }
  std::optional<vehicle_proximity_t> Proximity(int id) const { return Find(proximity.back().vehicles, id); }

  std::vector<event_t> Events(const std::string& code) const {
    std::vector<event_t> found;
    for (const event_t& event : events) {
      if (event.code == code) found.push_back(event);
    }
    return found;
  }

 private:
  template <typename Item>
  static std::optional<Item> Find(const std::vector<Item>& items, int id) {
    for (const Item& item : items) {
      if (item.id == id) return item;
    }
    return std::nullopt;
  }
};

}  // namespace skein::monitor::testing

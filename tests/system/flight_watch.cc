#include "system/flight_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/heartbeat_t.hpp>

#include "bus/channels.h"

namespace skein::testing {
namespace {

constexpr std::size_t kStatesKept = 40;
constexpr double kUnknown_m = std::numeric_limits<double>::infinity();

}  // namespace

std::pair<bool, double> Await(const std::function<bool()>& is_so, Seconds timeout) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const double passed_s = Seconds(std::chrono::steady_clock::now() - start).count();
    if (is_so()) return {true, passed_s};
    if (passed_s > timeout.count()) return {false, passed_s};
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

FlightWatch::FlightWatch(const std::string& lcm_url, FlightJudge& judge)
    : transport_(bus::MakeTransport(lcm_url)), executor_(transport_.lcm), judge_(judge) {
  const auto hear = [this]<typename Message>(const std::string& channel,
                                             void (*take)(FlightWatch&, const Message&)) {
    bus_.Subscribe<Message>(channel, [this, take](const Message& message) {
      const std::lock_guard lock(mutex_);
      take(*this, message);
    });
  };
  hear(
      bus::channel::kFleetRoster, +[](FlightWatch& watch, const fleet_roster_t& roster) {
        watch.flights_.insert(roster.start_utime);
        watch.judge_.Hear(roster);
      });
  hear(
      bus::channel::kCmdFleet,
      +[](FlightWatch& watch, const fleet_command_t& commands) { watch.judge_.Hear(commands); });
  hear(
      bus::channel::kFleetState, +[](FlightWatch& watch, const fleet_state_t& state) {
        watch.states_[state.tick] = state;
        if (watch.states_.size() > kStatesKept) watch.states_.erase(watch.states_.begin());
      });
  hear(
      bus::channel::kFormationStatus,
      +[](FlightWatch& watch, const formation_status_t& status) { watch.Hear(status); });
  hear(
      bus::channel::kFormation, +[](FlightWatch& watch, const formation_t& formation) {
        watch.formation_ = formation;
        watch.formation_.utime = 0;
      });
  hear(
      bus::channel::kPath, +[](FlightWatch& watch, const path_t& path) {
        watch.path_ = path;
        watch.path_.utime = 0;
      });
  hear(
      bus::channel::kHeartbeat, +[](FlightWatch& watch, const heartbeat_t& heartbeat) {
        std::int64_t& session = watch.sessions_[heartbeat.heartbeat_node];
        session = std::max(session, heartbeat.session_id);
      });
  hear(
      bus::channel::kAlarms, +[](FlightWatch& watch, const alarm_list_t& list) { watch.alarms_ = list; });
  executor_.Every(bus::kSecond / 2, [this] {
    heartbeat_t heartbeat{};
    heartbeat.utime = executor_.Now();
    heartbeat.heartbeat_node = kSilentNode;
    const std::lock_guard lock(mutex_);
    if (beats_ > 0) bus_.Publish(bus::channel::kHeartbeat, heartbeat), --beats_;
  });
  thread_ = std::thread([this] { executor_.Run(); });
}

FlightWatch::~FlightWatch() {
  executor_.Stop();
  thread_.join();
}

void FlightWatch::BeASilentNode() {
  const std::lock_guard lock(mutex_);
  beats_ = 4;
}

void FlightWatch::Hear(const formation_status_t& status) {
  judge_.Hear(status);
  const auto state = states_.find(status.tick);
  if (state == states_.end()) return;
  status_ = status;
  farthest_m_ = status.slots.empty() ? kUnknown_m : 0;
  for (const slot_status_t& slot : status.slots) {
    const auto& vehicles = state->second.vehicles;
    const auto uav = std::ranges::find(vehicles, slot.vehicle_id, &vehicle_state_t::id);
    farthest_m_ = std::max(farthest_m_, uav == vehicles.end() ? kUnknown_m
                                                              : std::hypot(slot.slot_east_m - uav->east_m,
                                                                           slot.slot_north_m - uav->north_m,
                                                                           slot.slot_up_m - uav->up_m));
  }
}

std::set<std::int64_t> FlightWatch::flights() const {
  const std::lock_guard lock(mutex_);
  return flights_;
}

bus::Utime FlightWatch::now() const {
  const std::lock_guard lock(mutex_);
  return states_.empty() ? 0 : states_.rbegin()->second.utime;
}

bool FlightWatch::IsHeard(int vehicle_id) const {
  const std::lock_guard lock(mutex_);
  return !states_.empty() &&
         std::ranges::any_of(states_.rbegin()->second.vehicles,
                             [&](const vehicle_state_t& uav) { return uav.id == vehicle_id; });
}

formation_t FlightWatch::formation() const {
  const std::lock_guard lock(mutex_);
  return formation_;
}

path_t FlightWatch::path() const {
  const std::lock_guard lock(mutex_);
  return path_;
}

formation_status_t FlightWatch::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::int64_t FlightWatch::session(const std::string& node) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(node);
  return found == sessions_.end() ? 0 : found->second;
}

std::optional<alarm_t> FlightWatch::Alarm(const std::string& condition, bus::Utime since) const {
  const std::lock_guard lock(mutex_);
  if (alarms_.utime <= since) return std::nullopt;
  const auto found = std::ranges::find_if(alarms_.alarms, [&](const alarm_t& alarm) {
    return alarm.condition == condition && alarm.state != alarm_t::OVER;
  });
  if (found == alarms_.alarms.end()) return std::nullopt;
  return *found;
}

double FlightWatch::FarthestFromSlot(bus::Utime since) const {
  const std::lock_guard lock(mutex_);
  return status_.utime > since ? farthest_m_ : kUnknown_m;
}

std::vector<std::string> FlightWatch::wrong() const {
  const std::lock_guard lock(mutex_);
  return judge_.wrong();
}

std::string FlightWatch::closest() const {
  const std::lock_guard lock(mutex_);
  return judge_.closest();
}

void FlightWatch::ExpectOtherPath() {
  const std::lock_guard lock(mutex_);
  judge_.ExpectOtherPath();
}

}  // namespace skein::testing

#include "monitor/collision_monitor_node.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <skein/event_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/proximity_t.hpp>
#include <stdexcept>
#include <unordered_map>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/refusals.h"

namespace skein::monitor {
namespace {

using bus::Utime;

constexpr Utime kLinkCheckPeriod = bus::kSecond / 10;
constexpr Utime kLinkStatusPeriod = bus::kSecond;
// FORMATION comes at 1 Hz. Until it can have come, nobody knows who is close on purpose, and a monitor that
// was started anew would warn of whole formations.
constexpr Utime kSettling = 2 * bus::kSecond;
constexpr std::size_t kMostNoticesAtOnce = 30;

KnownFormation ToKnownFormation(const formation_t& message) {
  KnownFormation formation{message.formation_id, {}, bus::ToProximityLimits(message)};
  for (const slot_t& slot : message.slots) formation.members.push_back(slot.vehicle_id);
  return formation;
}

std::string AlarmKey(const PairAlert& pair) {
  return fmt::format("proximity:{}-{}", pair.first_id, pair.second_id);
}

const char* CodeOf(AlertLevel level) {
  switch (level) {
    case AlertLevel::kClear:
      return "proximity_cleared";
    case AlertLevel::kAdvisory:
      return "proximity_advisory";
    case AlertLevel::kCaution:
      return "proximity_caution";
    case AlertLevel::kWarning:
      break;
  }
  return "proximity_warning";
}

const char* NameOf(AlertLevel level) {
  constexpr const char* kNames[] = {"clear", "advisory", "caution", "warning"};
  return kNames[static_cast<int>(level)];
}

}  // namespace

void Check(const CollisionMonitorOptions& options) {
  if (options.rate_hz < 1 || options.rate_hz > 10) throw std::invalid_argument("rate_hz: must be 1 .. 10");
  skein::Check(options.strangers);
  for (const KnownFormation& formation : options.formations) skein::Check(formation.limits);
  skein::Check(options.link_times);
  skein::Check(options.uncertainty);
}

CollisionMonitorNode::CollisionMonitorNode(bus::Bus& bus, const CollisionMonitorOptions& options)
    : bus_(bus),
      events_(bus),
      alarms_(bus, events_, options.state_file),
      link_memory_(alarms_.also_kept(), bus.executor().Now()),
      link_alarms_(alarms_, bus.executor().Now(), !link_memory_.empty()),
      silence_(bus, alarms_),
      clocks_(bus, alarms_),
      options_((Check(options), options)),
      membership_(bus.executor().Now(), options.strangers, options.formations),
      levels_from_(bus.executor().Now() + kSettling) {
  alarms_.AlsoKeep([this] { return link_memory_.Encode(bus_.executor().Now(), fleet_session_id_, uavs_); });
  bus::SubscribeChunks<fleet_roster_t>(
      bus, bus::channel::kFleetRoster,
      [this](const fleet_roster_t& roster, int missing) { HearRoster(roster, missing); }, &events_);
  bus::SubscribeChunks<fleet_state_t>(
      bus, bus::channel::kFleetState, [this](const fleet_state_t& state, int) { HearState(state); },
      &events_);
  bus.Subscribe<fleet_command_t>(bus::channel::kCmdFleet,
                                 [this](const fleet_command_t& commands) { HearCommands(commands); });
  bus.Subscribe<formation_t>(bus::channel::kFormation, [this](const formation_t& formation) {
    membership_.Hear(bus_.executor().Now(), ToKnownFormation(formation));
  });
  bus.executor().Every(kLinkCheckPeriod, [this] { CheckLinks(); });
  bus.executor().Every(bus::kSecond / options.rate_hz, [this] { Sweep(); });
}

void CollisionMonitorNode::StartFlight(const fleet_roster_t& roster) {
  const bool again = start_utime_ != 0;
  start_utime_ = roster.start_utime;
  if (!again && roster.scenario == options_.scenario) return;
  // At the start an operator may well have meant a scenario that the fleet does not know by name.
  if (!TakeScenario(roster.scenario, again) && !again) return;
  const Utime now = bus_.executor().Now();
  if (again) {
    // Nothing of what was in the air before is there any more.
    for (const auto& [id, uav] : uavs_) link_alarms_.Forget(uav);
    for (const PairAlert& pair : levels_.active()) alarms_.End(AlarmKey(pair));
    uavs_.clear();
    levels_ = AlertLevels();
  }
  levels_from_ = now + kSettling;
  membership_ = Membership(now, options_.strangers, options_.formations);
}

bool CollisionMonitorNode::TakeScenario(const std::string& name, bool again) {
  if (!options_.find_options || name.empty()) return false;
  const auto found = options_.find_options(name);
  if (!found && !again) return false;
  if (!found) {
    events_.Tell(event_t::CAUTION, "scenario_missing",
                 fmt::format("there is no scenario \"{}\" here: strangers are kept apart by the usual "
                             "thresholds, not by its own",
                             name));
  }
  const CollisionMonitorOptions taken = found.value_or(CollisionMonitorOptions());
  options_.scenario = name;
  options_.strangers = taken.strangers;
  options_.formations = taken.formations;
  return true;
}

void CollisionMonitorNode::HearRoster(const fleet_roster_t& roster, int missing_chunks) {
  if (roster.start_utime != start_utime_) StartFlight(roster);
  std::map<int, const vehicle_info_t*> listed;
  for (const vehicle_info_t& info : roster.vehicles) listed[info.id] = &info;
  // Who has left is forgotten; should it be heard on, it comes back as one that is not in the roster.
  if (missing_chunks == 0) {
    std::erase_if(uavs_, [&](const auto& uav) {
      if (!uav.second.in_roster() || listed.contains(uav.first)) return false;
      link_alarms_.Forget(uav.second);
      return true;
    });
  }
  for (const auto& [id, info] : listed) {
    Watch(id, info->callsign, true, roster.session_id).Enrol(info->callsign);
  }
}

void CollisionMonitorNode::HearState(const fleet_state_t& state) {
  // Another flight: everybody may be elsewhere.
  if (state.session_id != fleet_session_id_ || state.tick < fleet_tick_) {
    for (auto& [id, uav] : uavs_) uav.ForgetPlace();
  }
  fleet_session_id_ = state.session_id;
  fleet_tick_ = state.tick;
  const Utime now = bus_.executor().Now();
  link_alarms_.HearFleet(now);
  std::vector<Notice> notices;
  for (const vehicle_state_t& vehicle : state.vehicles) {
    WatchedUav& uav = Watch(vehicle.id, fmt::format("UAV #{}", vehicle.id), false, state.session_id);
    const auto heard = uav.Hear(now, {vehicle.utime, bus::ToVehicleState(vehicle), vehicle.command_session_id,
                                      vehicle.command_sequence});
    if (!heard.credible) bus::CountFlagged(bus_);
    if (heard.notice) notices.push_back(*heard.notice);
  }
  Tell(std::move(notices));
}

WatchedUav& CollisionMonitorNode::Watch(int id, const std::string& callsign, bool in_roster,
                                        std::int64_t session_id) {
  const Utime now = bus_.executor().Now();
  const auto [uav, is_new] = uavs_.try_emplace(id, id, callsign, in_roster, now, options_.link_times);
  if (!is_new) return uav->second;
  if (const auto memory = link_memory_.Take(session_id, id)) uav->second.Recall(now, *memory);
  return uav->second;
}

void CollisionMonitorNode::HearCommands(const fleet_command_t& commands) {
  // Commands to another fleet, out of a recording perhaps, are no proof of how this one's uplinks are.
  if (commands.to_session_id != fleet_session_id_) return;
  const Utime now = bus_.executor().Now();
  membership_.HearCommands(now);
  for (const vehicle_command_t& command : commands.commands) {
    const auto uav = uavs_.find(command.id);
    if (uav != uavs_.end()) uav->second.HearCommand(now, commands.session_id);
  }
}

void CollisionMonitorNode::CheckLinks() {
  const Utime now = bus_.executor().Now();
  if (held_up_.MustListen(now)) return;
  membership_.Forget(now);
  bool changed = false;
  std::vector<Notice> notices;
  for (auto entry = uavs_.begin(); entry != uavs_.end();) {
    WatchedUav& uav = entry->second;
    WatchedUav::Judgement judgement = uav.Judge(now);
    changed = changed || judgement.changed;
    if (!uav.in_roster() && uav.watch().downlink() == LinkState::kLost) {
      link_alarms_.Forget(uav);
      entry = uavs_.erase(entry);
      continue;
    }
    std::ranges::move(link_alarms_.Take(now, uav, std::move(judgement)), std::back_inserter(notices));
    ++entry;
  }
  if (auto notice = link_alarms_.Look(now, uavs_.size())) notices.push_back(std::move(*notice));
  if (changed || now - links_sent_ >= kLinkStatusPeriod) PublishLinks(now);
  Tell(std::move(notices));
}

void CollisionMonitorNode::PublishLinks(Utime now) {
  link_status_t status;
  status.utime = now;
  status.sequence = link_sequence_++;
  for (const auto& [id, uav] : uavs_) {
    vehicle_link_t& link = status.links.emplace_back();
    link.id = id;
    link.downlink = static_cast<std::int8_t>(uav.watch().downlink());
    link.uplink = static_cast<std::int8_t>(uav.watch().uplink());
    const auto downlink_age = uav.watch().downlink_age_us(now);
    const auto uplink_age = uav.watch().uplink_age_us();
    link.downlink_age_s = downlink_age ? bus::ToSeconds(*downlink_age) : -1;
    link.uplink_age_s = uplink_age ? bus::ToSeconds(*uplink_age) : -1;
    if (const auto estimate = uav.Locate(now, options_.uncertainty)) {
      link.estimated_east_m = estimate->position.x();
      link.estimated_north_m = estimate->position.y();
      link.estimated_up_m = estimate->position.z();
      link.horizontal_uncertainty_m = estimate->horizontal_uncertainty_m;
      link.vertical_uncertainty_m = estimate->vertical_uncertainty_m;
    }
  }
  bus::PublishChunks(bus_, bus::channel::kLinkStatus, status);
  links_sent_ = now;
}

std::vector<Traffic> CollisionMonitorNode::Locate(Utime now) const {
  std::vector<Traffic> fleet;
  for (const auto& [id, uav] : uavs_) {
    const auto estimate = uav.Locate(now, options_.uncertainty);
    if (!estimate) continue;
    fleet.push_back({id, estimate->position, estimate->velocity, membership_.FormationOf(id),
                     estimate->horizontal_uncertainty_m, estimate->vertical_uncertainty_m});
  }
  return fleet;
}

void CollisionMonitorNode::Sweep() {
  const Utime now = bus_.executor().Now();
  const std::vector<Traffic> fleet = Locate(now);
  index_.Load(fleet, membership_.rules());
  std::vector<Notice> notices;
  if (now >= levels_from_) {
    for (const AlertChange& change : levels_.Sweep(now, index_)) {
      const Notice notice = Describe(change, fleet);
      RaiseOrEnd(change, notice);
      const bool worse = change.pair.level > change.before;
      if (worse || change.pair.level == AlertLevel::kClear) notices.push_back(notice);
    }
  }
  PublishProximity(now);
  Tell(std::move(notices));
}

void CollisionMonitorNode::RaiseOrEnd(const AlertChange& change, const Notice& notice) {
  const PairAlert& pair = change.pair;
  const std::string key = AlarmKey(pair);
  // An advisory is for looking, not for acting: PROXIMITY and the table show it.
  if (pair.level < AlertLevel::kCaution) return alarms_.End(key);
  alarms_.Raise({key, pair.level, notice.text, pair.first_id, pair.second_id, notice.formation_id});
}

void CollisionMonitorNode::PublishProximity(Utime now) {
  struct Worst {
    AlertLevel level = AlertLevel::kClear;
    int with_id = 0;
  };
  std::unordered_map<int, Worst> worst;  // of equals the smallest id: pairs come in that order
  for (const PairAlert& pair : levels_.active()) {
    if (Worst& first = worst[pair.first_id]; pair.level > first.level) first = {pair.level, pair.second_id};
    if (Worst& second = worst[pair.second_id]; pair.level > second.level)
      second = {pair.level, pair.first_id};
  }

  proximity_t message;
  message.utime = now;
  message.sweep = sweep_++;
  for (const VehicleProximity& found : index_.FindProximity()) {
    vehicle_proximity_t& vehicle = message.vehicles.emplace_back();
    vehicle.id = found.id;
    vehicle.level = static_cast<std::int8_t>(worst[found.id].level);
    vehicle.level_with_id = worst[found.id].with_id;
    vehicle.nearest_id = found.nearest ? found.nearest->id : 0;
    vehicle.nearest_horizontal_m = found.nearest ? found.nearest->separation.horizontal_m : -1;
    vehicle.nearest_vertical_m = found.nearest ? found.nearest->separation.vertical_m : -1;
    vehicle.tau_id = found.least_tau ? found.least_tau->id : 0;
    vehicle.tau_s = found.least_tau ? found.least_tau->tau_s : -1;
  }
  bus::PublishChunks(bus_, bus::channel::kProximity, message);
}

std::string CollisionMonitorNode::CallsignOf(int id) const {
  const auto uav = uavs_.find(id);
  return uav == uavs_.end() ? fmt::format("UAV #{}", id) : uav->second.callsign();
}

Notice CollisionMonitorNode::Describe(const AlertChange& change, const std::vector<Traffic>& fleet) const {
  const PairAlert& pair = change.pair;
  Notice notice{static_cast<std::int8_t>(pair.level), CodeOf(pair.level), "", pair.first_id, 0};
  const std::string both = CallsignOf(pair.first_id) + " and " + CallsignOf(pair.second_id);
  const auto find = [&](int id) {
    return std::find_if(fleet.begin(), fleet.end(), [&](const Traffic& uav) { return uav.id == id; });
  };
  const auto first = find(pair.first_id);
  const auto second = find(pair.second_id);
  if (first == fleet.end() || second == fleet.end()) {
    notice.text = fmt::format("{}: {} over, as one of them is gone", both, NameOf(pair.worst));
    return notice;
  }
  if (first->formation_id == second->formation_id) notice.formation_id = first->formation_id;

  const Separation separation = Separate(first->position, second->position);
  const std::string distances =
      fmt::format("R {:.0f} m, H {:.0f} m", separation.horizontal_m, separation.vertical_m);
  if (pair.level == AlertLevel::kClear) {
    notice.text = fmt::format("{}: {} over, {}", both, NameOf(pair.worst), distances);
    return notice;
  }
  const ProximityLimits& limits = membership_.rules().Between(*first, *second);
  const auto tau_s = Tau(MotionBetween(*first, *second), limits.d_mod_m, limits.min_closing_m_s);
  notice.text = fmt::format("{}: {}, {}{}", both, NameOf(pair.level), distances,
                            tau_s ? fmt::format(", Tau {:.0f} s", *tau_s) : ", not closing");
  return notice;
}

void CollisionMonitorNode::Tell(std::vector<Notice> notices) {
  std::stable_sort(notices.begin(), notices.end(),
                   [](const Notice& one, const Notice& other) { return one.severity > other.severity; });
  const std::size_t told = std::min(notices.size(), kMostNoticesAtOnce);
  for (std::size_t i = 0; i < told; ++i) {
    const Notice& notice = notices[i];
    events_.Tell(notice.severity, notice.code, notice.text, {notice.vehicle_id, notice.formation_id});
  }
  if (told < notices.size()) {
    events_.Tell(notices[told].severity, "more_events",
                 fmt::format("and {} more at the same time", notices.size() - told));
  }
}

}  // namespace skein::monitor

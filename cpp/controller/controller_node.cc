#include "controller/controller_node.h"

#include <algorithm>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "controller/formation_message.h"
#include "core/frames.h"

namespace skein::controller {

int StatusEveryTicks(std::size_t formations) {
  constexpr std::size_t kMostATick = 5;
  return static_cast<int>(std::clamp<std::size_t>((formations + kMostATick - 1) / kMostATick, 4, 20));
}

FormationControllerNode::FormationControllerNode(bus::Bus& bus, const ControllerOptions& options)
    : bus_(bus),
      options_(options),
      events_(bus),
      state_file_(options.state_file, "formation-controller 4", events_),
      inbox_(bus) {
  bus::SubscribeChunks<fleet_roster_t>(
      bus_, bus::channel::kFleetRoster, [this](const fleet_roster_t& roster, int) { OnRoster(roster); },
      &events_);
  bus::SubscribeChunks<fleet_state_t>(
      bus_, bus::channel::kFleetState, [this](const fleet_state_t& state, int) { OnFleetState(state); },
      &events_);
  bus::SubscribeChunks<link_status_t>(bus_, bus::channel::kLinkStatus,
                                      [this](const link_status_t& status, int) { OnLinkStatus(status); });
  inbox_.Obey<formation_command_t>(bus::channel::kCmdFormation, [this](const formation_command_t& command) {
    return OnFormationCommand(command);
  });
  inbox_.Obey<path_command_t>(bus::channel::kCmdPath,
                              [this](const path_command_t& command) { return OnPathCommand(command); });
  bus_.executor().Every(
      bus::kSecond / kRepeatParts,
      [this] {
        StartWaiting(kStartInAPart);
        RepeatFormations();
      },
      bus::kBetweenTicks);
  bus_.executor().Every(
      bus::kSecond, [this] { SaveState(); }, bus::kBetweenTicks);
}

void FormationControllerNode::OnRoster(const fleet_roster_t& roster) {
  // A roster by itself ends no flight: whoever says that the fleet is another one has to fly it.
  if (start_utime_ != 0 && roster.session_id != fleet_session_id_) {
    unflown_roster_ = roster;
    return;
  }
  unflown_roster_.reset();
  for (const vehicle_info_t& info : roster.vehicles) {
    VehicleView& view = fleet_[info.id];
    view.id = info.id;
    view.callsign = info.callsign;
    view.model = bus::ToVehicleModel(info);
  }
  if (roster.start_utime == start_utime_) return;
  const bool again = start_utime_ != 0;
  start_utime_ = roster.start_utime;
  // A fleet that starts anew knows nothing of what was flown before.
  tick_utime_ = 0;
  flights_.clear();
  waiting_.clear();
  held_.clear();
  for (auto& [id, view] : fleet_) {
    view.state.reset();
    view.lost = false;
  }
  std::erase_if(fleet_, [&](const auto& entry) {
    return std::none_of(roster.vehicles.begin(), roster.vehicles.end(),
                        [&](const vehicle_info_t& info) { return info.id == entry.first; });
  });
  if (again)
    events_.Tell(event_t::INFO, "fleet_restarted", "the fleet has started anew; so do the formations");
  TakeScenario(roster.scenario, again);
  if (!RestoreState()) StartScenario();
}

void FormationControllerNode::OnLinkStatus(const link_status_t& status) {
  for (const vehicle_link_t& link : status.links) {
    const auto view = fleet_.find(link.id);
    if (view == fleet_.end()) continue;
    const auto either = [&](std::int8_t state) { return link.downlink == state || link.uplink == state; };
    // A monitor that was started anew does not know at first: what was lost stays so until it does.
    if (either(link_status_t::LINK_LOST)) {
      view->second.lost = true;
    } else if (!either(link_status_t::LINK_UNKNOWN)) {
      view->second.lost = false;
    }
  }
}

void FormationControllerNode::OnFleetState(const fleet_state_t& state) {
  if (unflown_roster_ && unflown_roster_->session_id == state.session_id) {
    fleet_session_id_ = state.session_id;
    OnRoster(*std::exchange(unflown_roster_, std::nullopt));
  }
  // Which ticks are taken, and when a clock was set, SubscribeChunks has decided. After a jump the leaders go
  // on from where they are: they must neither stand still until a clock comes round again nor be moved by
  // hours at once.
  // A tick may come late, and does when this process was held up; one that is ahead of what both clocks say
  // has a false time, or a clock that was set.
  constexpr bus::Utime kLongestGap = 60 * bus::kSecond;
  constexpr bus::Utime kMostAhead = 2 * bus::kSecond;
  // Leaders do not catch up with a start that is longer ago: no flight is, but a false roster may say so.
  constexpr bus::Utime kLongestFlight = 24 * 3600 * bus::kSecond;
  const bus::Utime ahead = state.utime - bus_.executor().Now();
  const bool known = tick_utime_ != 0;
  const bool jumped = known && (state.utime <= tick_utime_ || state.utime > tick_utime_ + kLongestGap ||
                                ahead > clock_ahead_ + kMostAhead);
  const bool far_from_start =
      !known && (state.utime < start_utime_ || state.utime > start_utime_ + kLongestFlight);
  if (jumped || far_from_start) {
    for (auto& [id, view] : fleet_) view.TakeClock(state.utime);
    for (auto& [id, flight] : flights_) flight.TakeClock(state.utime);
  }
  clock_ahead_ = known && !jumped ? std::max(clock_ahead_, ahead) : ahead;
  fleet_session_id_ = state.session_id;
  tick_utime_ = state.utime;
  tick_ = state.tick;
  for (auto& [id, view] : fleet_) view.fresh = false;
  for (const vehicle_state_t& vehicle : state.vehicles) {
    const auto view = fleet_.find(vehicle.id);
    if (view != fleet_.end()) view->second.Take(bus::ToVehicleState(vehicle), vehicle.utime, tick_utime_);
  }

  std::vector<FlightCommand> commands = HoldTheRest();
  for (auto& [id, flight] : flights_) {
    FlightStep step = flight.Step(fleet_, tick_utime_);
    commands.insert(commands.end(), step.commands.begin(), step.commands.end());
    for (const FlightEvent& event : step.events) Tell(flight, event);
  }
  bus::Burst burst(bus_);
  SendCommands(commands, burst);
  SendStatuses(burst);
  ++ticks_heard_;
}

std::vector<FlightCommand> FormationControllerNode::HoldTheRest() {
  std::vector<int> flown;
  for (const auto& [id, flight] : flights_) {
    for (const Slot& slot : flight.config().slots) flown.push_back(slot.vehicle_id);
  }
  std::ranges::sort(flown);
  std::vector<FlightCommand> commands;
  for (const auto& [id, view] : fleet_) {
    if (!view.state || std::ranges::binary_search(flown, id)) {
      held_.erase(id);
      continue;
    }
    VehicleState held = held_.try_emplace(id, *view.state).first->second;
    // What a silent UAV does about an old difference in altitude nobody sees: it is to stay level.
    if (!view.fresh) held.up_m = view.state->up_m;
    // One that is not heard is still commanded, so that its uplink can be judged.
    if (view.fresh || view.lost) commands.push_back({id, HoldAltitude(held, *view.state, view.model)});
  }
  return commands;
}

void FormationControllerNode::SendCommands(const std::vector<FlightCommand>& commands, bus::Burst& burst) {
  if (commands.empty()) return;
  ++sequence_;
  fleet_command_t whole;
  whole.utime = tick_utime_;
  whole.session_id = bus_.session_id();
  whole.to_session_id = fleet_session_id_;
  whole.state_tick = tick_;
  whole.commands.reserve(commands.size());
  for (const FlightCommand& from : commands) {
    vehicle_command_t command;
    command.id = from.vehicle_id;
    command.sequence = sequence_;
    command.speed_input_m_s = from.output.input.speed_m_s;
    command.course_input_rad = from.output.input.course_rad;
    command.climb_input_rad = from.output.input.climb_rad;
    command.setpoint_speed_m_s = from.output.setpoint.speed_m_s;
    command.setpoint_course_rad = WrapAngle(from.output.setpoint.course_rad);
    command.setpoint_climb_rad = from.output.setpoint.climb_rad;
    command.setpoint_acceleration_m_s2 = from.output.rates.acceleration_m_s2;
    command.setpoint_course_rate_rad_s = from.output.rates.course_rate_rad_s;
    command.setpoint_climb_rate_rad_s = from.output.rates.climb_rate_rad_s;
    whole.commands.push_back(command);
  }
  for (fleet_command_t& chunk : bus::Split(whole)) {
    chunk.request_id = ++request_id_;
    burst.Publish(bus::channel::kCmdFleet, chunk);
  }
}

void FormationControllerNode::SendFormation(const FormationFlight& flight) {
  bus::Burst burst(bus_);
  SendFormation(flight, burst);
}

void FormationControllerNode::SendFormation(const FormationFlight& flight, bus::Burst& burst) {
  burst.Publish(bus::channel::kFormation, FormationMessage(flight, bus_.executor().Now()));
  burst.Publish(bus::channel::kPath, PathMessage(flight, bus_.executor().Now()));
}

void FormationControllerNode::RepeatFormations() {
  // For those who join late. Each has its part of the second: all at once would fill receive buffers.
  std::size_t index = 0;
  bus::Burst burst(bus_);
  for (const auto& [id, flight] : flights_) {
    if (index++ % kRepeatParts == repeat_part_) SendFormation(flight, burst);
  }
  repeat_part_ = (repeat_part_ + 1) % kRepeatParts;
}

void FormationControllerNode::SendStatuses(bus::Burst& burst) {
  // Each formation has its tick, too.
  const int every =
      options_.status_every_ticks > 0 ? options_.status_every_ticks : StatusEveryTicks(flights_.size());
  std::int64_t index = 0;
  for (const auto& [id, flight] : flights_) {
    if ((ticks_heard_ - index++) % every != 0) continue;
    bus::PublishChunks(burst, bus::channel::kFormationStatus, flight.Status(tick_));
  }
}

void FormationControllerNode::Tell(const FormationFlight& flight, const FlightEvent& event) {
  const std::string& name = flight.config().name;
  const std::string text = flights_.size() < 2 ? event.text : (name + ": " + event.text);
  events_.Tell(event.severity, event.code, text, {event.vehicle_id, flight.config().id});
}

}  // namespace skein::controller

#include "simulator/simulator_node.h"

#include <skein/event_t.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"

namespace skein::simulator {
namespace {

constexpr std::int64_t kTicksPerRoster = bus::kSecond / FleetSimulatorNode::kPeriod;

/// The roster of a large fleet is spread over some ticks: together with the state it would overrun receivers'
/// buffers.
constexpr int kRosterChunksPerTick = 2;

/// A link longer than this would hold back more messages than anybody wants.
constexpr double kLongestDelay_s = 60;

std::vector<SimulatedVehicle> MakeFleet(const SimulatorOptions& options, bus::Utime start) {
  std::vector<SimulatedVehicle> fleet;
  fleet.reserve(options.scenario.vehicles.size());
  for (const config::VehicleConfig& vehicle : options.scenario.vehicles) {
    fleet.emplace_back(vehicle, start, options.seed);
  }
  return fleet;
}

fleet_roster_t MakeRoster(const config::Scenario& scenario, bus::Utime start, std::int64_t session_id) {
  fleet_roster_t roster{};
  roster.session_id = session_id;
  roster.scenario = scenario.name;
  roster.start_utime = start;
  roster.origin_latitude_deg = scenario.origin.latitude_deg;
  roster.origin_longitude_deg = scenario.origin.longitude_deg;
  roster.origin_altitude_m = scenario.origin.altitude_m;
  roster.revision = 1;
  for (const config::VehicleConfig& vehicle : scenario.vehicles) {
    roster.vehicles.push_back(
        bus::ToMessage(vehicle.id, vehicle.callsign, vehicle.model, vehicle.has_payload));
  }
  roster.num_vehicles = static_cast<int>(roster.vehicles.size());
  return roster;
}

LinkChange ToLinkChange(const link_command_t& command) {
  LinkChange::Direction direction;
  switch (command.mode) {
    case link_command_t::MODE_SILENT:
      direction.mode = LinkMode::kSilent;
      break;
    case link_command_t::MODE_FROZEN:
      direction.mode = LinkMode::kFrozen;
      break;
    default:
      direction.mode = LinkMode::kUp;
      direction.quality = config::LinkQuality{command.delay_s, command.jitter_s, command.loss};
  }
  LinkChange change;
  change.vehicle_id = command.vehicle_id;
  if (command.uplink) change.uplink = direction;
  if (command.downlink) change.downlink = direction;
  change.duration_s = command.duration_s;
  return change;
}

}  // namespace

FleetSimulatorNode::FleetSimulatorNode(bus::Bus& bus, const SimulatorOptions& options)
    : bus_(bus),
      events_(bus),
      inbox_(bus),
      start_utime_(bus.executor().Now()),
      fleet_(MakeFleet(options, start_utime_)),
      links_(fleet_,
             [this](const SimulatedVehicle& vehicle, const std::string& code, const std::string& text) {
               events_.Tell(event_t::INFO, code, text, {.vehicle_id = vehicle.id()});
             }),
      roster_(bus::Split(MakeRoster(options.scenario, start_utime_, bus.session_id()))),
      roster_sent_(roster_.size()) {
  for (std::size_t i = 0; i < fleet_.size(); ++i) index_[fleet_[i].id()] = i;
  links_.AddTimeline(options.scenario.timeline, start_utime_, options.scenario.timeline_repeat_s);

  bus_.Subscribe<fleet_command_t>(bus::channel::kCmdFleet,
                                  [this](const fleet_command_t& command) { Command(command); });
  inbox_.Obey<link_command_t>(bus::channel::kCmdLink,
                              [this](const link_command_t& command) { return SetLink(command); });
  inbox_.Obey<payload_command_t>(bus::channel::kCmdPayload,
                                 [this](const payload_command_t& command) { return SwitchPayload(command); });
  bus_.executor().At(start_utime_, [this] { Tick(); });
  bus_.executor().Every(
      kPeriod, [this] { Tick(); }, start_utime_);
}

void FleetSimulatorNode::Tick() {
  const std::int64_t due = (bus_.executor().Now() - start_utime_) / kPeriod;
  if (due <= tick_) return;
  // A process that was held up makes up for the flight, not for the reports that nobody can use any more.
  while (tick_ < due) Fly(tick_ + 1);
  PublishRoster();
  PublishState();
}

void FleetSimulatorNode::Fly(std::int64_t tick) {
  tick_ = tick;
  const bus::Utime utime = start_utime_ + tick * kPeriod;
  for (SimulatedVehicle& vehicle : fleet_) {
    const bool payload_before = vehicle.payload_on();
    vehicle.FlyTo(utime);
    if (vehicle.payload_on() != payload_before) {
      events_.Tell(event_t::INFO, vehicle.payload_on() ? "payload_on" : "payload_off",
                   "payload of " + vehicle.callsign() + (vehicle.payload_on() ? " is on" : " is off"),
                   {.vehicle_id = vehicle.id()});
    }
  }
  links_.RunUntil(utime);
}

void FleetSimulatorNode::PublishRoster() {
  if (roster_sent_ == roster_.size() && tick_ >= roster_due_) {
    roster_sent_ = 0;
    roster_due_ = tick_ + kTicksPerRoster;
    for (fleet_roster_t& chunk : roster_) chunk.utime = start_utime_ + tick_ * kPeriod;
  }
  for (int i = 0; i < kRosterChunksPerTick && roster_sent_ < roster_.size(); ++i) {
    bus_.Publish(bus::channel::kFleetRoster, roster_[roster_sent_++]);
  }
}

void FleetSimulatorNode::PublishState() {
  fleet_state_t state{};
  state.utime = start_utime_ + tick_ * kPeriod;
  state.session_id = bus_.session_id();
  state.tick = tick_;
  state.vehicles.reserve(fleet_.size());
  for (SimulatedVehicle& vehicle : fleet_) {
    if (const auto heard = vehicle.Telemetry()) state.vehicles.push_back(*heard);
  }
  state.num_vehicles = static_cast<int>(state.vehicles.size());
  bus::PublishChunks(bus_, bus::channel::kFleetState, state);
}

void FleetSimulatorNode::Command(const fleet_command_t& command) {
  if (command.session_id == command_session_id_ && command.request_id > command_request_id_ + 1) {
    bus_.CountGaps(command.request_id - command_request_id_ - 1);
  }
  if (std::tie(command.session_id, command.request_id) > std::tie(command_session_id_, command_request_id_)) {
    command_session_id_ = command.session_id;
    command_request_id_ = command.request_id;
  }
  // Each UAV sees for itself whether its command is a newer one.
  const bus::Utime now = bus_.executor().Now();
  for (const vehicle_command_t& one : command.commands) {
    SimulatedVehicle* vehicle = Find(one.id);
    if (!vehicle) continue;
    const AutopilotInput input{one.speed_input_m_s, one.course_input_rad, one.climb_input_rad};
    vehicle->Send(now, FlightCommand{command.session_id, one.sequence, input});
  }
}

bus::Answer FleetSimulatorNode::SetLink(const link_command_t& command) {
  if (!Find(command.vehicle_id)) {
    return bus::Answer::Refused("there is no UAV " + std::to_string(command.vehicle_id));
  }
  if (!command.uplink && !command.downlink)
    return bus::Answer::Refused("neither uplink nor downlink is meant");
  if (command.delay_s < 0 || command.jitter_s < 0 || command.delay_s + command.jitter_s > kLongestDelay_s) {
    return bus::Answer::Refused("delay and jitter must be 0 to 60 s together");
  }
  if (command.loss < 0 || command.loss > 1) return bus::Answer::Refused("loss must be 0 to 1");
  if (command.duration_s < 0) return bus::Answer::Refused("the duration must not be negative");
  links_.Add(ToLinkChange(command), bus_.executor().Now(), command.start_utime);
  return bus::Answer::Accepted();
}

bus::Answer FleetSimulatorNode::SwitchPayload(const payload_command_t& command) {
  if (command.vehicle_ids.empty()) return bus::Answer::Refused("no UAV is named");
  std::string unreachable;
  for (const int id : command.vehicle_ids) {
    const SimulatedVehicle* vehicle = Find(id);
    if (!vehicle) return bus::Answer::Refused("there is no UAV " + std::to_string(id));
    if (!vehicle->has_payload()) return bus::Answer::Refused(vehicle->callsign() + " has no payload");
    if (vehicle->uplink().mode != LinkMode::kUp)
      unreachable += (unreachable.empty() ? "" : ", ") + vehicle->callsign();
  }
  const bus::Utime now = bus_.executor().Now();
  for (const int id : command.vehicle_ids) Find(id)->Send(now, PayloadSwitch{command.on != 0});
  return bus::Answer::Accepted(unreachable.empty() ? "" : "the uplink is cut: " + unreachable);
}

SimulatedVehicle* FleetSimulatorNode::Find(int vehicle_id) {
  const auto found = index_.find(vehicle_id);
  return found == index_.end() ? nullptr : &fleet_[found->second];
}

}  // namespace skein::simulator

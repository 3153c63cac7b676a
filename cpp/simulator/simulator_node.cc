#include "simulator/simulator_node.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <skein/event_t.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/refusals.h"

namespace skein::simulator {
namespace {

constexpr std::int64_t kTicksPerRoster = bus::kSecond / FleetSimulatorNode::kPeriod;

/// A link longer than this would hold back more messages than anybody wants.
constexpr double kLongestDelay_s = 60;

/// No network that Skein can fly over brings a command later.
constexpr bus::Utime kOnItsWay = 2 * bus::kSecond;

std::vector<SimulatedVehicle> MakeFleet(const SimulatorOptions& options, bus::Utime start) {
  std::vector<SimulatedVehicle> fleet;
  fleet.reserve(options.scenario.vehicles.size());
  for (const config::VehicleConfig& vehicle : options.scenario.vehicles) {
    fleet.emplace_back(vehicle, start, options.seed);
  }
  return fleet;
}

fleet_roster_t MakeRoster(const config::Scenario& scenario, bus::Utime start) {
  fleet_roster_t roster{};
  roster.session_id = start;
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
    case link_command_t::MODE_RESTORED:
      direction.as_at_start = true;
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

FleetSimulatorNode::Flight::Flight(const SimulatorOptions& options, bus::Utime start, bus::Events& events)
    : start_utime(start),
      fleet(MakeFleet(options, start)),
      links(
          fleet,
          [this, &events](const SimulatedVehicle& vehicle, const std::string& code, const std::string& text) {
            if (tells) events.Tell(event_t::INFO, code, text, {.vehicle_id = vehicle.id()});
          }),
      roster(bus::Split(MakeRoster(options.scenario, start))),
      roster_sent(roster.size()) {
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    index[fleet[i].id()] = i;
    motion.Add(fleet[i].state(), fleet[i].input(), fleet[i].model());
  }
  links.AddTimeline(options.scenario.timeline, start, options.scenario.timeline_repeat_s);
}

void FleetSimulatorNode::Flight::Recall(const FlightState& state) {
  tick = state.tick;
  roster_due = tick;
  // All that was asked of the links comes about once more, and nobody need be told again.
  tells = false;
  for (const LinkOrder& order : state.link_orders) {
    links.RunUntil(order.utime);
    links.Add(ToLinkChange(order.command), order.utime, order.command.start_utime);
  }
  links.RunUntil(start_utime + tick * kPeriod);
  tells = true;
  link_orders = state.link_orders;
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    fleet[i].Recall(state.vehicles[i]);
    motion.SetState(i, fleet[i].state());
    motion.SetInput(i, fleet[i].input());
  }
}

FleetSimulatorNode::FleetSimulatorNode(bus::Bus& bus, const SimulatorOptions& options)
    : bus_(bus),
      options_(options),
      events_(bus),
      state_file_(options.state_file, "fleet-simulator 1", events_),
      inbox_(bus),
      started_with_(options.scenario.file),
      flight_(StartOrGoOn()) {
  bus_.Subscribe<fleet_command_t>(bus::channel::kCmdFleet,
                                  [this](const fleet_command_t& command) { Command(command); });
  inbox_.Obey<link_command_t>(bus::channel::kCmdLink,
                              [this](const link_command_t& command) { return SetLink(command); });
  inbox_.Obey<payload_command_t>(bus::channel::kCmdPayload,
                                 [this](const payload_command_t& command) { return SwitchPayload(command); });
  inbox_.Obey<simulation_command_t>(
      bus::channel::kCmdSimulation,
      [this](const simulation_command_t& command) { return StartAnew(command); });
  bus_.executor().At(start_utime(), [this] { Tick(); });
  bus_.executor().Every(
      kPeriod, [this] { Tick(); }, start_utime());
  SaveNow();  // also who is killed at once is to come back to the same flight
  if (state_file_.kept())
    bus_.executor().Every(bus::kSecond, [this] { state_file_.Save(Encode(StateNow())); });
}

bus::Utime FleetSimulatorNode::NextTick(bus::Utime now) { return (now + kPeriod - 1) / kPeriod * kPeriod; }

std::unique_ptr<FleetSimulatorNode::Flight> FleetSimulatorNode::StartOrGoOn() {
  const bus::Utime now = bus_.executor().Now();
  const auto bytes = state_file_.Read();
  const auto state = bytes ? DecodeFlightState(*bytes) : std::nullopt;
  if (bytes && !state) state_file_.SetAside("it holds no flight");
  const bus::Utime gap = state ? now - (state->start_utime + state->tick * kPeriod) : 0;
  if (!state || state->started_with != started_with_ || gap < -bus::kSecond || gap > kLongestGap)
    return std::make_unique<Flight>(options_, NextTick(now), events_);
  if (state->scenario != started_with_) options_.scenario = config::LoadScenario(state->scenario);
  options_.seed = state->seed;
  auto flight = std::make_unique<Flight>(options_, state->start_utime, events_);
  const bool same = std::ranges::equal(flight->fleet, state->vehicles, {}, &SimulatedVehicle::id,
                                       [](const auto& memory) { return memory.report.id; });
  if (!same)
    return std::make_unique<Flight>(options_, NextTick(now), events_);  // the file was edited meanwhile
  flight->Recall(*state);
  events_.Tell(
      event_t::ADVISORY, "simulator_restarted",
      fmt::format("the simulator is back and goes on with the flight, {:.1f} s after it was last kept",
                  bus::ToSeconds(gap)));
  return flight;
}

FlightState FleetSimulatorNode::StateNow() const {
  FlightState state{
      started_with_, options_.scenario.file, options_.seed, start_utime(), tick(), flight_->link_orders, {}};
  for (const SimulatedVehicle& vehicle : fleet()) state.vehicles.push_back(vehicle.Remember());
  return state;
}

void FleetSimulatorNode::SaveNow() {
  if (state_file_.kept()) state_file_.SaveNow(Encode(StateNow()));
}

void FleetSimulatorNode::Tick() {
  const bus::Utime since_start = bus_.executor().Now() - start_utime();
  if (since_start < 0) return;  // a flight that begins at the next tick
  const std::int64_t due = since_start / kPeriod;
  if (due <= tick()) return;
  // A process that was held up makes up for the flight, not for the reports that nobody can use any more.
  while (tick() < due) Fly(tick() + 1);
  bus::Burst burst(bus_);
  PublishRoster(burst);
  PublishState(burst);
}

void FleetSimulatorNode::Fly(std::int64_t tick) {
  const bus::Utime utime = start_utime() + tick * kPeriod;
  flight_->tick = tick;
  std::vector<SimulatedVehicle>& fleet = flight_->fleet;
  FleetMotion& motion = flight_->motion;
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    SimulatedVehicle& vehicle = fleet[i];
    const bool payload_before = vehicle.payload_on();
    vehicle.Hear(utime);
    motion.SetInput(i, vehicle.input());
    if (vehicle.payload_on() != payload_before) {
      events_.Tell(event_t::INFO, vehicle.payload_on() ? "payload_on" : "payload_off",
                   "payload of " + vehicle.callsign() + (vehicle.payload_on() ? " is on" : " is off"),
                   {.vehicle_id = vehicle.id()});
    }
  }
  if (tick > 0) motion.Step(bus::ToSeconds(kPeriod));  // tick 0 is the start itself
  for (std::size_t i = 0; i < fleet.size(); ++i) fleet[i].ArriveAt(utime, motion.State(i));
  flight_->links.RunUntil(utime);
}

void FleetSimulatorNode::PublishRoster(bus::Burst& burst) {
  Flight& flight = *flight_;
  if (flight.roster_sent == flight.roster.size() && tick() >= flight.roster_due) {
    flight.roster_sent = 0;
    flight.roster_due = tick() + kTicksPerRoster;
    for (fleet_roster_t& chunk : flight.roster) chunk.utime = start_utime() + tick() * kPeriod;
  }
  // One in a tick: together with the state all would overrun receivers' buffers.
  if (flight.roster_sent < flight.roster.size()) {
    burst.Publish(bus::channel::kFleetRoster, flight.roster[flight.roster_sent++]);
  }
}

void FleetSimulatorNode::PublishState(bus::Burst& burst) {
  fleet_state_t state{};
  state.utime = start_utime() + tick() * kPeriod;
  state.session_id = start_utime();
  state.tick = tick();
  state.vehicles.reserve(fleet().size());
  for (SimulatedVehicle& vehicle : flight_->fleet) {
    if (const auto heard = vehicle.Telemetry()) state.vehicles.push_back(*heard);
  }
  state.num_vehicles = static_cast<int>(state.vehicles.size());
  bus::PublishChunks(burst, bus::channel::kFleetState, state);
}

void FleetSimulatorNode::Command(const fleet_command_t& command) {
  const bus::Utime now = bus_.executor().Now();
  const auto refuse = [this](const char* why) { bus::Refuse(bus_, bus::channel::kCmdFleet, why); };
  // Meant for the flight before this one, or out of the recording of another: however new the session of its
  // controller is, it must not take over. When a flight begins, answers to the one before are on their way.
  if (command.to_session_id != start_utime()) {
    if (now - start_utime() > kOnItsWay) refuse("it commands another flight");
    return;
  }
  // Nor may its request id stand, or none that is true would be counted as missed any more.
  if (command.state_tick > (now + kOnItsWay - start_utime()) / kPeriod)
    return refuse("it answers a state that is yet to come");
  // A later session that is silent may be a false one that was heard once.
  if (command.session_id < command_session_id_ && now - commanded_ > kOnItsWay) command_session_id_ = 0;
  // What the network doubles or brings late is ordinary, and a gap where it should have been.
  const bool newer =
      std::tie(command.session_id, command.request_id) > std::tie(command_session_id_, command_request_id_);
  if (command.session_id < command_session_id_) {
    refuse("it is of an earlier run of the controller");
  } else if (!newer && command.state_tick < tick() - kOnItsWay / kPeriod) {
    refuse("it is old");
  }
  if (command.session_id == command_session_id_ && command.request_id > command_request_id_ + 1) {
    bus_.CountGaps(command.request_id - command_request_id_ - 1);
  }
  if (command.session_id >= command_session_id_) commanded_ = now;
  if (newer) {
    command_session_id_ = command.session_id;
    command_request_id_ = command.request_id;
  }
  // Each UAV sees for itself whether its command is a newer one.
  bool all_known = true;
  for (const vehicle_command_t& one : command.commands) {
    SimulatedVehicle* vehicle = Find(one.id);
    all_known = all_known && vehicle;
    if (!vehicle) continue;
    const AutopilotInput input{one.speed_input_m_s, one.course_input_rad, one.climb_input_rad};
    vehicle->Send(now, FlightCommand{command.session_id, one.sequence, input});
  }
  if (!all_known) refuse("it commands a UAV that is not in this fleet");
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
  flight_->link_orders.push_back({bus_.executor().Now(), command});
  flight_->links.Add(ToLinkChange(command), bus_.executor().Now(), command.start_utime);
  SaveNow();
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

bus::Answer FleetSimulatorNode::StartAnew(const simulation_command_t& command) {
  const bool load = command.action == simulation_command_t::ACTION_LOAD;
  SimulatorOptions options = options_;
  if (command.seed > 0) options.seed = static_cast<std::uint64_t>(command.seed);
  try {
    const auto& own = options_.scenario.file;
    // Read again to restart, too: what the file says now is what the other nodes will find.
    if (load || !own.empty()) {
      options.scenario = config::LoadScenario(load ? config::FindNamedScenario(command.scenario, own) : own);
    }
  } catch (const config::ConfigError& error) {
    return bus::Answer::Refused(error.what());
  }
  options_ = std::move(options);
  flight_ = std::make_unique<Flight>(options_, start_utime() + (tick() + 1) * kPeriod, events_);
  SaveNow();
  events_.Tell(event_t::INFO, "simulation_started",
               "the simulation starts anew: " + options_.scenario.name + ", " +
                   std::to_string(fleet().size()) + (fleet().size() == 1 ? " UAV" : " UAVs"));
  return bus::Answer::Accepted();
}

SimulatedVehicle* FleetSimulatorNode::Find(int vehicle_id) {
  const auto found = flight_->index.find(vehicle_id);
  return found == flight_->index.end() ? nullptr : &flight_->fleet[found->second];
}

}  // namespace skein::simulator

#include "experiment/preview.h"

#include <algorithm>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <set>
#include <skein/ack_t.hpp>
#include <skein/formation_command_t.hpp>
#include <skein/link_status_t.hpp>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "core/frames.h"
#include "experiment/experiment.h"

namespace skein::experiment {
namespace {

constexpr std::int64_t kTicksPerSample = 10;
constexpr std::size_t kPairsTold = 10;
constexpr std::size_t kMostTrackPoints = 20'000;
/// All have been in their slots for so long: they stay.
constexpr double kSettled_s = 20;
/// The roster of a large fleet takes some ticks to be told.
constexpr int kMostLeadingSteps = 1'000;

/// The fleet of a picture, with perfect links to all but those whose link is lost.
config::Scenario ScenarioOf(const FlightPicture& picture) {
  config::Scenario scenario;
  scenario.name = "preview";
  scenario.ceiling_m = picture.ceiling_m;
  scenario.strangers = picture.strangers;
  for (const FlightPicture::Vehicle& from : picture.vehicles) {
    config::VehicleConfig vehicle;
    vehicle.id = from.info.id;
    vehicle.callsign = from.info.callsign;
    vehicle.model = bus::ToVehicleModel(from.info);
    vehicle.has_payload = from.info.has_payload;
    if (from.state) vehicle.start = *from.state;
    // Nothing gets through to a UAV that is lost, and so it does what dead reckoning supposes. That what it
    // tells is heard changes nothing: LINK_STATUS says that it is lost.
    if (from.lost || !from.state) vehicle.uplink.loss = 1;
    if (!from.state) vehicle.downlink.loss = 1;
    scenario.vehicles.push_back(std::move(vehicle));
  }
  return scenario;
}

link_status_t LinksOf(const FlightPicture& picture) {
  link_status_t status{};
  status.utime = picture.utime;
  for (const FlightPicture::Vehicle& vehicle : picture.vehicles) {
    vehicle_link_t link{};
    link.id = vehicle.info.id;
    const std::int8_t state = vehicle.lost ? link_status_t::LINK_LOST : link_status_t::LINK_UP;
    link.downlink = link.uplink = vehicle.state ? state : link_status_t::LINK_UNKNOWN;
    status.links.push_back(link);
  }
  status.num_links = static_cast<int>(status.links.size());
  return status;
}

ExperimentOptions OptionsOf(const FlightPicture& picture) {
  ExperimentOptions options;
  options.start = picture.utime;
  options.formations = controller::ControllerState{picture.utime, picture.formations};
  options.monitor = false;
  options.logs = false;
  return options;
}

/// A picture that goes on, and what it is about.
class FlightAhead {
 public:
  explicit FlightAhead(const FlightPicture& picture) : experiment_(ScenarioOf(picture), OptionsOf(picture)) {
    experiment_.operator_bus().Subscribe<ack_t>(bus::channel::kAck, [this](const ack_t& ack) { ack_ = ack; });
    // The controller is in the picture when it commands somebody.
    for (int step = 0; step < kMostLeadingSteps && !commands_; ++step) Step();
    bus::PublishChunks(experiment_.operator_bus(), bus::channel::kLinkStatus, LinksOf(picture));
    Step();
  }

  const controller::FormationControllerNode& controller() const { return experiment_.controller(); }
  const Tick& tick() const { return *tick_; }
  /// Since the command.
  double t_s() const { return tick_->t_s - start_s_; }

  const Tick& Step() {
    tick_ = &experiment_.Step();
    commands_ = std::any_of(tick_->vehicles.begin(), tick_->vehicles.end(),
                            [](const VehicleTick& vehicle) { return vehicle.command.has_value(); });
    return *tick_;
  }

  /// Sends a command as an operator does, and flies on for the step in which it is answered.
  template <typename Command>
  bus::Answer Send(const std::string& channel, Command command) {
    command.utime = tick_->utime;
    command.session_id = experiment_.operator_bus().session_id();
    command.request_id = 1;
    command.to_session_id = command.session_id;  // the nodes of an experiment start at the same moment
    start_s_ = tick_->t_s;
    experiment_.operator_bus().Publish(channel, command);
    Step();
    if (!ack_) return bus::Answer::Refused("the controller did not answer");
    return {ack_->accepted != 0, ack_->reason};
  }

 private:
  Experiment experiment_;
  std::optional<ack_t> ack_;
  const Tick* tick_ = nullptr;
  bool commands_ = false;
  double start_s_ = 0;
};

/// Who is in a formation, by the picture and after a change.
struct Members {
  std::set<int> matter;             ///< members of the formation that changes, old and new
  std::map<int, int> formation_of;  ///< after the change
  ProximityRules rules;
};

Members MembersAfter(const FlightPicture& picture, const formation_t& changed) {
  Members members;
  members.rules.strangers = picture.strangers;
  const auto add = [&](const formation_t& formation) {
    for (const slot_t& slot : formation.slots) members.formation_of[slot.vehicle_id] = formation.formation_id;
    members.rules.formations[formation.formation_id] = bus::ToProximityLimits(formation);
  };
  for (const controller::FormationState& state : picture.formations) {
    if (state.formation.formation_id != changed.formation_id) {
      add(state.formation);
      continue;
    }
    for (const slot_t& slot : state.formation.slots) members.matter.insert(slot.vehicle_id);
  }
  add(changed);
  for (const slot_t& slot : changed.slots) members.matter.insert(slot.vehicle_id);
  return members;
}

/// Watches a flight from the moment at which its change was taken.
class PreviewBuilder {
 public:
  PreviewBuilder(const FlightPicture& picture, const formation_t& changed)
      : members_(MembersAfter(picture, changed)),
        cylinders_(members_.matter, members_.formation_of, members_.rules, Unknown(picture)),
        slots_(changed.formation_id),
        limits_(Models(picture, members_.matter)),
        unknown_(Unknown(picture)) {}

  void Add(const Tick& tick, double t_s) {
    cylinders_.Add(tick, t_s);
    slots_.Add(tick, t_s);
    limits_.Add(tick, t_s, t_s - last_t_s_);
    if (samples_++ % kTicksPerSample == 0) Sample(tick, t_s);
    last_t_s_ = t_s;
  }

  bool settled() const {
    return slots_.settled_since_s() && last_t_s_ - *slots_.settled_since_s() >= kSettled_s;
  }

  void Finish(const Tick& tick, Preview& preview) {
    Sample(tick, last_t_s_);
    preview.duration_s = last_t_s_;
    preview.nearest = cylinders_.Worst(kPairsTold);
    preview.settle_s = slots_.settled_since_s();
    preview.limits = limits_.Binding();
    std::set<int> told = members_.matter;
    for (const CylinderApproach& pair : preview.nearest) told.insert({pair.first_id, pair.second_id});
    for (auto& [id, track] : tracks_) {
      if (told.contains(id)) preview.tracks.push_back({id, std::move(track)});
    }
    preview.tracks = Thinned(std::move(preview.tracks), kMostTrackPoints);
  }

 private:
  static std::set<int> Unknown(const FlightPicture& picture) {
    std::set<int> unknown;
    for (const auto& vehicle : picture.vehicles) {
      if (!vehicle.state) unknown.insert(vehicle.info.id);
    }
    return unknown;
  }

  static std::map<int, VehicleModel> Models(const FlightPicture& picture, const std::set<int>& ids) {
    std::map<int, VehicleModel> models;
    for (const auto& vehicle : picture.vehicles) {
      if (ids.contains(vehicle.info.id)) models[vehicle.info.id] = bus::ToVehicleModel(vehicle.info);
    }
    return models;
  }

  void Sample(const Tick& tick, double t_s) {
    for (const VehicleTick& vehicle : tick.vehicles) {
      if (unknown_.contains(vehicle.id)) continue;
      std::vector<TrackPoint>& track = tracks_[vehicle.id];
      if (track.empty() || track.back().t_s < t_s) track.push_back({t_s, Position(vehicle.truth)});
    }
  }

  Members members_;
  CylinderWatch cylinders_;
  SlotWatch slots_;
  LimitWatch limits_;
  std::set<int> unknown_;
  std::map<int, std::vector<TrackPoint>> tracks_;
  std::int64_t samples_ = 0;
  double last_t_s_ = 0;
};

/// Flies on after a change that was taken, until `done`.
template <typename Done>
void Fly(FlightAhead& flight, const FlightPicture& picture, const formation_t& changed,
         const PreviewOptions& options, Done done, Preview& preview) {
  PreviewBuilder builder(picture, changed);
  builder.Add(flight.tick(), flight.t_s());
  while (!(preview.complete = done(builder)) && flight.t_s() < options.longest_s) {
    if (options.stop && options.stop()) break;
    builder.Add(flight.Step(), flight.t_s());
  }
  builder.Finish(flight.tick(), preview);
}

/// Of the leader, from one arc length to another.
double FlightTime(const Path& path, double from_m, double to_m) {
  // Simpson's rule; speed changes over hundreds of metres.
  constexpr double kStep_m = 50;
  const int steps = 2 * std::max(1, static_cast<int>(std::ceil((to_m - from_m) / (2 * kStep_m))));
  const double step_m = (to_m - from_m) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight / path.SpeedAt(from_m + i * step_m);
  }
  return sum * step_m / 3;
}

std::vector<FlownLeg> LegsOf(const path_command_t& command, const controller::PathPlan& plan,
                             double leader_arc_m) {
  const Path& path = *plan.path;
  std::vector<std::pair<double, std::size_t>> passes;
  for (std::size_t i = 0; i < plan.waypoint_arcs_m.size(); ++i)
    passes.emplace_back(plan.waypoint_arcs_m[i], i);
  std::stable_sort(passes.begin(), passes.end());
  if (path.closed() && !passes.empty()) {
    passes.emplace_back(passes.front().first + path.lap_m(), passes.front().second);
  }
  std::vector<FlownLeg> legs;
  double from_m = leader_arc_m;
  Eigen::Vector2d from = path.At(leader_arc_m).position;
  std::optional<std::size_t> from_waypoint;
  for (const auto& [to_m, to_waypoint] : passes) {
    const waypoint_t& point = command.waypoints[to_waypoint];
    const Eigen::Vector2d to(point.east_m, point.north_m);
    const Eigen::Vector2d way = to - from;
    legs.push_back({from_waypoint, to_waypoint, to_m - from_m, FlightTime(path, from_m, to_m),
                    std::atan2(way.y(), way.x())});
    from_m = to_m;
    from = to;
    from_waypoint = to_waypoint;
  }
  return legs;
}

}  // namespace

Preview PreviewFormation(const FlightPicture& picture, const formation_t& formation,
                         const PreviewOptions& options) {
  Preview preview;
  FlightAhead flight(picture);
  formation_command_t command{};
  command.action = formation_command_t::ACTION_APPLY;
  command.formation = formation;
  const bus::Answer answer = flight.Send(bus::channel::kCmdFormation, command);
  preview.ok = answer.accepted;
  preview.reason = answer.reason;
  if (preview.ok) {
    Fly(
        flight, picture, formation, options, [](const PreviewBuilder& builder) { return builder.settled(); },
        preview);
  }
  return preview;
}

PathPreview PreviewPath(const FlightPicture& picture, const path_command_t& path,
                        const PreviewOptions& options) {
  PathPreview preview;
  FlightAhead flight(picture);
  const auto plan = flight.controller().PlanPath(path);
  if (plan) {
    preview.problems = plan->problems;
    if (plan->path) {
      preview.leader_arc_m = flight.controller().flights().at(path.formation_id).leader().arc_m();
      preview.legs = LegsOf(path, *plan, preview.leader_arc_m);
      preview.path = plan->path;
    }
  }
  const bus::Answer answer = flight.Send(bus::channel::kCmdPath, path);
  preview.flight.ok = answer.accepted;
  preview.flight.reason = answer.reason;
  if (!preview.flight.ok || !(options.longest_s > 0)) return preview;

  const auto changed =
      std::find_if(picture.formations.begin(), picture.formations.end(),
                   [&](const auto& state) { return state.formation.formation_id == path.formation_id; });
  const VirtualLeader& leader = flight.controller().flights().at(path.formation_id).leader();
  double hindmost_m = 0;
  for (const slot_t& slot : changed->formation.slots) hindmost_m = std::min(hindmost_m, slot.forward_m);
  const Path& flown = *preview.path;
  const double once_m = flown.closed() ? plan->joins_at_m + flown.lap_m() : flown.end_arc_m();
  Fly(
      flight, picture, changed->formation, options,
      [&](const PreviewBuilder&) { return leader.arc_m() + hindmost_m >= once_m; }, preview.flight);
  return preview;
}

}  // namespace skein::experiment

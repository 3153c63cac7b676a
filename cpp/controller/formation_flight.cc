#include "controller/formation_flight.h"

#include <algorithm>
#include <cmath>

#include "controller/rejoin_prediction.h"
#include "core/frames.h"

namespace skein::controller {
namespace {

constexpr double kFirstStep = 0.05;  // [s], before there is a last one

// A UAV this near its slot (horizontally) counts as in place again, whatever its way there was.
constexpr double kMergeDistance = 50;

constexpr std::size_t kMostToPredict = 50;

/// Where the UAV is, on the course that it has; climbing as `slot` does. It closes in only when its level is
/// its own.
SlotReference StraightOn(SlotReference slot, const VehicleState& uav, const Envelope& envelope) {
  slot.position.head<2>() = Position(uav).head<2>();
  slot.course_rad = uav.course_rad;
  slot.course_rate_rad_s = 0;
  slot.speed_m_s = std::clamp(uav.speed_m_s, 1.1 * envelope.min_speed_m_s, 0.9 * envelope.max_speed_m_s);
  slot.acceleration_m_s2 = 0;
  return slot;
}

VehicleState Lowered(VehicleState state, double seconds, double rate_m_s) {
  state.up_m -= rate_m_s * seconds;
  return state;
}

}  // namespace

FormationFlight::FormationFlight(const config::FormationConfig& config, VirtualLeader leader,
                                 const Airspace& airspace)
    : config_(config), leader_(std::move(leader)), airspace_(airspace) {
  for (const Slot& slot : config_.slots) members_.emplace(slot.vehicle_id, MakeMember(slot));
}

void FormationFlight::TakeClock(bus::Utime utime) {
  leader_ = VirtualLeader(leader_.path(), leader_.arc_m(), bus::ToSeconds(utime));
  utime_ = utime;
  for (auto& [id, member] : members_) member.controlled_utime = member.predict_utime = 0;
}

void FormationFlight::GoOnFrom(const formation_status_t& status) {
  avoidance_.Restore({status.avoidance_up_m, status.avoidance_rate_m_s, 0}, status.avoidance_target_m);
  utime_ = status.utime;
  mode_ = status.mode;
  mode_utime_ = status.mode_utime;
}

FormationFlight::Member FormationFlight::MakeMember(const Slot& slot) const {
  Member member;
  member.slot = slot.offset;
  if (config_.control == "paper") {
    member.law = PaperLaw(PaperParametersFrom(config_.gains));
  } else {
    member.law = SkeinLaw(SkeinLawParametersFrom(config_.gains));
  }
  return member;
}

FlightStep FormationFlight::Step(const FleetPicture& fleet, bus::Utime utime) {
  const double step_s = utime_ == 0 ? 0 : std::max(0.0, bus::ToSeconds(utime - utime_));
  utime_ = utime;
  leader_.AdvanceTo(bus::ToSeconds(utime));
  here_ = leader_.path().At(leader_.arc_m());

  std::vector<MemberObservation> observations;
  for (auto& [id, member] : members_) {
    member.planned = PlaceOf(member.slot, {});
    const auto view = fleet.find(id);
    const bool heard = view != fleet.end() && view->second.state;
    observations.push_back(heard ? Observe(id, member, view->second) : Unheard(id));
  }
  const bool somebody_lost = std::any_of(observations.begin(), observations.end(),
                                         [](const MemberObservation& seen) { return seen.lost; });
  FlightStep step;
  step.events = avoidance_.Update(
      observations, somebody_lost || avoidance_.active() ? Strangers(fleet) : std::vector<Traffic>(),
      Surroundings(fleet), step_s);
  for (auto& [id, member] : members_) {
    member.flown = false;
    const auto view = fleet.find(id);
    if (view == fleet.end() || !view->second.state) {
      Measure(id, member, nullptr);
      continue;
    }
    if (avoidance_.role(id) == Role::kLost) {
      step.commands.push_back({id, HoldLost(member, view->second)});
    } else {
      member.held.reset();
      member.flown = true;
      if (view->second.fresh) {
        step.commands.push_back({id, Fly(member, view->second, avoidance_.offset(id))});
      }
    }
    Measure(id, member, &view->second);
  }
  UpdateMode(fleet);
  return step;
}

MemberObservation FormationFlight::Unheard(int id) const {
  MemberObservation seen;
  seen.id = id;
  seen.heard = false;
  return seen;
}

MemberObservation FormationFlight::Observe(int id, Member& member, const VehicleView& view) {
  MemberObservation seen;
  seen.id = id;
  seen.callsign = view.callsign;
  seen.lost = view.lost;
  const VehicleState now = view.At(utime_);
  seen.level_m = now.up_m - member.planned.position.z();
  seen.track = {Position(now), Velocity(now)};
  seen.in_place = SlotError(member.planned, Position(now)).head<2>().norm() < kMergeDistance;
  seen.ready_to_merge = avoidance_.role(id) == Role::kRejoining && ReadyToMerge(id, member, view);
  return seen;
}

bool FormationFlight::ReadyToMerge(int id, Member& member, const VehicleView& view) {
  const SlotReference slot = PlaceOf(member.slot, avoidance_.offset(id));
  if (SlotError(slot, Position(view.At(utime_))).head<2>().norm() < kMergeDistance) return true;

  // Farther away the others may come down early when flying it ahead shows that nobody gets near. Once a
  // second, and not in formations so large that it would cost the tick.
  const auto* law = std::get_if<SkeinLaw>(&member.law);
  if (!law || members_.size() > kMostToPredict || avoidance_.changing_level(id)) return false;
  if (utime_ < member.predict_utime) return false;
  member.predict_utime = utime_ + bus::kSecond;
  const auto descent = [this](int member_id) {
    AltitudeRamp ramp(avoidance_.offset(member_id), avoidance_.body().limits());
    ramp.SetTarget(0);
    return ramp;
  };
  std::vector<DescendingMember> others;
  for (const auto& [other_id, other] : members_) {
    if (other_id == id) continue;
    if (avoidance_.role(other_id) != Role::kFlying) return false;
    others.push_back({other.slot, descent(other_id)});
  }
  const double arc = leader_.ArcAt(bus::ToSeconds(view.state_utime));
  return ClearsEveryCylinder(leader_.path(), arc, {member.slot, descent(id), *law, *view.state, view.model},
                             std::move(others), config_.proximity);
}

double FormationFlight::ClimbRate(const FleetPicture& fleet) const {
  constexpr double kFastest = 10;  // [m/s]
  constexpr double kSlowest = 2;   // [m/s]
  constexpr double kShare = 0.8;   // of the steepest climb; the rest is left to control
  double rate = kFastest;
  for (const auto& [id, member] : members_) {
    const auto view = fleet.find(id);
    if (view == fleet.end() || !view->second.state) continue;
    const double steepest =
        view->second.state->speed_m_s * std::sin(kShare * view->second.model.envelope.max_climb_rad);
    rate = std::min(rate, steepest - std::abs(here_.speed_m_s * here_.up_slope));
  }
  return std::max(rate, kSlowest);
}

std::vector<Traffic> FormationFlight::Strangers(const FleetPicture& fleet) const {
  std::vector<Traffic> strangers;
  for (const auto& [id, view] : fleet) {
    if (!view.state || members_.contains(id)) continue;
    const VehicleState now = view.At(utime_);
    strangers.push_back({Position(now), Velocity(now)});
  }
  return strangers;
}

AirspaceLimits FormationFlight::Surroundings(const FleetPicture& fleet) const {
  AirspaceLimits limits;
  limits.strangers = airspace_.strangers;
  // Cylinder, dead-reckoning uncertainty (up to 50 m) and room to level off.
  limits.clearance_m = config_.proximity.height_m + 50 + 20;
  limits.climb_rate_m_s = ClimbRate(fleet);
  for (const auto& [id, member] : members_) {
    const double planned_m = member.planned.position.z();
    limits.highest_m = std::min(limits.highest_m, airspace_.ceiling_m - planned_m);
    limits.lowest_m = std::max(limits.lowest_m, airspace_.floor_m - planned_m);
  }
  return limits;
}

LawOutput FormationFlight::Fly(Member& member, const VehicleView& view, const AltitudeOffset& offset) {
  const double step_s =
      member.controlled_utime == 0
          ? kFirstStep
          : std::clamp(bus::ToSeconds(view.state_utime - member.controlled_utime), 0.001, 1.0);
  member.controlled_utime = view.state_utime;

  // The UAV is compared with the leader at the UAV's own time stamp.
  const double age = bus::ToSeconds(utime_ - view.state_utime);
  const double arc = leader_.ArcAt(bus::ToSeconds(view.state_utime));
  if (auto* law = std::get_if<SkeinLaw>(&member.law)) {
    const AltitudeOffset then{offset.height_m - offset.rate_m_s * age, offset.rate_m_s,
                              offset.acceleration_m_s2};
    // Telemetry of this very tick finds the slot worked out already.
    const bool is_planned = arc == here_.arc_m && then == AltitudeOffset{};
    SlotReference slot = is_planned ? member.planned : SlotOnPath(leader_.path(), arc, member.slot, then);
    if (avoidance_.changing_level(view.id)) slot = StraightOn(slot, *view.state, view.model.envelope);
    return law->Control(slot, *view.state, view.model, step_s);
  }
  const VehicleState leader = Lowered(LeaderState(leader_.path(), arc, offset), age, offset.rate_m_s);
  LawOutput output;
  output.input = std::get<PaperLaw>(member.law).Update(leader, member.slot, *view.state, view.model, step_s);
  output.rates = Respond(*view.state, output.input, view.model);
  const Envelope& envelope = view.model.envelope;
  output.setpoint.speed_m_s =
      std::clamp(output.input.speed_m_s, envelope.min_speed_m_s, envelope.max_speed_m_s);
  output.setpoint.course_rad = output.input.course_rad;
  output.setpoint.climb_rad =
      std::clamp(output.input.climb_rad, -envelope.max_climb_rad, envelope.max_climb_rad);
  return output;
}

LawOutput FormationFlight::HoldLost(Member& member, const VehicleView& view) const {
  if (!member.held) {
    member.held = *view.state;
    if (auto* law = std::get_if<PaperLaw>(&member.law)) law->Freeze();
  }
  // Not heard: whatever gets through must do no harm, so level at the speed and course last heard. Heard, and
  // only the uplink gone: the same, so that it does nothing new when commands get through again.
  member.held->course_rad = view.fresh ? view.state->course_rad : member.held->course_rad;
  VehicleState level = *member.held;
  level.up_m = view.state->up_m;
  return HoldAltitude(level, *view.state, view.model);
}

SlotReference FormationFlight::PlaceOf(const SlotOffset& slot, const AltitudeOffset& offset) const {
  if (config_.control != "paper") return SlotOnPath(leader_.path(), here_, slot, offset);
  // The paper's slots are rigid in the leader's own frame.
  const VehicleState leader = LeaderState(leader_.path(), leader_.arc_m(), offset);
  SlotReference place;
  place.position = Position(leader);
  place.position.head<2>() += FromLeaderFrame({slot.forward_m, slot.left_m}, leader.course_rad);
  place.position.z() += slot.up_m;
  place.course_rad = leader.course_rad;
  return place;
}

void FormationFlight::Measure(int id, Member& member, const VehicleView* view) {
  const AltitudeOffset offset = member.flown ? avoidance_.offset(id) : avoidance_.body().now();
  const SlotReference place = offset == AltitudeOffset{} ? member.planned : PlaceOf(member.slot, offset);
  member.slot_position = place.position;
  member.error = view ? SlotError(place, Position(view->At(utime_))) : Eigen::Vector3d(0, 0, 0);
}

}  // namespace skein::controller

// What the station tells about a formation.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "bus/text.h"
#include "controller/formation_flight.h"

namespace skein::controller {
namespace {

// Assembled when everybody is this near its slot, apart again when somebody is this far from it.
constexpr double kAssembled = 25;
constexpr double kApart = 60;
// Of names in a text for people.
constexpr std::size_t kLongestList = 300;

std::string Distance(double metres) {
  return metres < 1000 ? fmt::format("{:.0f} m", metres) : fmt::format("{:.1f} km", metres / 1000);
}

/// The whole of it, and what is left: "climbing 200 m (8 m to go)".
std::string ClimbText(double whole_m, double left_m, const char* where_to = "") {
  std::string text =
      fmt::format("{} {:.0f} m{}", whole_m > 0 ? "climbing" : "descending", std::abs(whole_m), where_to);
  if (std::abs(whole_m - left_m) >= 1) text += fmt::format(" ({:.0f} m to go)", std::ceil(std::abs(left_m)));
  return text;
}

}  // namespace

void FormationFlight::UpdateMode(const FleetPicture& fleet) {
  std::string lost;
  std::string rejoining;
  double rejoin_distance = 0;
  const std::pair<const int, Member>* farthest = nullptr;
  bool all_heard = !members_.empty();
  const auto name = [&](int id) {
    const auto view = fleet.find(id);
    return view == fleet.end() ? fmt::format("UAV {}", id) : view->second.callsign;
  };
  for (const auto& entry : members_) {
    const auto& [id, member] = entry;
    const auto view = fleet.find(id);
    if (view == fleet.end() || !view->second.state) {
      all_heard = false;
      continue;
    }
    if (avoidance_.role(id) == Role::kLost) {
      lost += (lost.empty() ? "" : ", ") + name(id);
    } else if (avoidance_.role(id) == Role::kRejoining) {
      rejoining += (rejoining.empty() ? "" : ", ") + name(id);
      rejoin_distance = std::max(rejoin_distance, member.error.head<2>().norm());
    }
    if (!farthest || member.error.norm() > farthest->second.error.norm()) farthest = &entry;
  }

  lost = bus::Shortened(lost, kLongestList);
  rejoining = bus::Shortened(rejoining, kLongestList);

  const AltitudeRamp& body = avoidance_.body();
  if (body.target_m() != climb_to_m_) {
    climb_from_m_ = body.now().height_m;
    climb_to_m_ = body.target_m();
  }
  const double whole_m = climb_to_m_ - climb_from_m_;
  const double left_m = climb_to_m_ - body.now().height_m;
  const auto level = [&]() -> std::string {
    if (body.target_m() == 0) return "at the planned altitude";
    return fmt::format("{:.0f} m {} the planned altitude", std::abs(body.target_m()),
                       body.target_m() > 0 ? "above" : "below");
  };
  const auto level_or_climb = [&] { return body.settled() ? level() : ClimbText(whole_m, left_m); };
  const bool loiters =
      before_hold_ || (!leader_.path().closed() && leader_.arc_m() > leader_.path().end_arc_m() &&
                       leader_.path().At(leader_.arc_m()).curvature_per_m != 0);
  std::int8_t mode = mode_;
  mode_end_utime_ = 0;
  if (!all_heard && !farthest) {
    mode = formation_status_t::MODE_WAITING;
    mode_text_ = "waiting for telemetry";
  } else if (!lost.empty()) {
    mode = formation_status_t::MODE_AVOIDING;
    mode_text_ = fmt::format("{}: link of {} lost", level_or_climb(), lost);
    if (avoidance_.blocked()) mode_text_ += "; no altitude is free";
  } else if (!rejoining.empty()) {
    mode = formation_status_t::MODE_REJOINING;
    mode_text_ = fmt::format("{}: {} rejoins, {} from its slot", level_or_climb(), rejoining,
                             Distance(rejoin_distance));
  } else if (avoidance_.active() && !body.settled()) {
    mode = formation_status_t::MODE_REJOINING;
    mode_text_ = ClimbText(whole_m, left_m, " to the planned altitude");
  } else if (avoidance_.blocked()) {
    mode = formation_status_t::MODE_REJOINING;
    mode_text_ = level() + ": other traffic is in the way to the planned altitude";
  } else if (loiters) {
    mode = formation_status_t::MODE_HOLDING;
    mode_text_ = before_hold_ ? "loitering: hold" : "loitering: end of its path";
  } else {
    const double error = farthest->second.error.norm();
    const bool was_in = mode_ == formation_status_t::MODE_IN_FORMATION;
    const bool in = all_heard && error < (was_in ? kApart : kAssembled);
    mode = in ? formation_status_t::MODE_IN_FORMATION : formation_status_t::MODE_ASSEMBLING;
    mode_text_ = in ? "in formation"
                    : fmt::format("assembling: {} {} from its slot", name(farthest->first), Distance(error));
    if (!all_heard) mode_text_ += "; not all UAVs are heard";
  }
  if (!body.settled()) mode_end_utime_ = utime_ + bus::ToUtime(body.RemainingTime());
  if (mode != mode_ || mode_utime_ == 0) mode_utime_ = utime_;
  mode_ = mode;
}

formation_status_t FormationFlight::Status(std::int64_t tick) const {
  formation_status_t status;
  status.utime = utime_ != 0 ? utime_ : bus::ToUtime(leader_.time_s());
  status.formation_id = config_.id;
  status.tick = tick;
  status.mode = mode_;
  status.mode_utime = mode_utime_;
  status.mode_end_utime = mode_end_utime_;
  status.mode_text = bus::Shortened(mode_text_);
  const AltitudeOffset& offset = avoidance_.body().now();
  const VehicleState leader = LeaderState(leader_.path(), leader_.arc_m(), offset);
  status.leader_east_m = leader.east_m;
  status.leader_north_m = leader.north_m;
  status.leader_up_m = leader.up_m;
  status.leader_speed_m_s = leader.speed_m_s;
  status.leader_course_rad = leader.course_rad;
  status.leader_climb_rad = leader.climb_rad;
  status.leader_arc_m = leader_.arc_m();
  status.path_revision = path_revision_;
  status.avoidance_up_m = offset.height_m;
  status.avoidance_rate_m_s = offset.rate_m_s;
  status.avoidance_target_m = avoidance_.body().target_m();
  status.chunk = 0;
  status.chunk_count = 1;
  for (const auto& [id, member] : members_) {
    slot_status_t slot;
    slot.vehicle_id = id;
    slot.slot_east_m = member.slot_position.x();
    slot.slot_north_m = member.slot_position.y();
    slot.slot_up_m = member.slot_position.z();
    slot.forward_error_m = member.error.x();
    slot.left_error_m = member.error.y();
    slot.up_error_m = member.error.z();
    slot.flown = member.flown;
    status.slots.push_back(slot);
  }
  status.num_slots = static_cast<int>(status.slots.size());
  return status;
}

}  // namespace skein::controller

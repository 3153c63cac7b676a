#include "controller/avoidance.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <skein/event_t.hpp>
#include <utility>
#include <vector>

namespace skein::controller {

Role Avoidance::role(int id) const {
  const auto member = members_.find(id);
  return member == members_.end() ? Role::kFlying : member->second.role;
}

AltitudeOffset Avoidance::offset(int id) const {
  const auto member = members_.find(id);
  return member == members_.end() ? body_.now() : member->second.ramp.now();
}

bool Avoidance::changing_level(int id) const {
  const auto member = members_.find(id);
  return member != members_.end() && member->second.role == Role::kRejoining &&
         !member->second.ramp.settled();
}

bool Avoidance::active() const {
  return body_.target_m() != 0 || !body_.settled() ||
         std::any_of(members_.begin(), members_.end(), [](const auto& entry) {
           return entry.second.role != Role::kFlying || !entry.second.ramp.settled();
         });
}

void Avoidance::Restore(const AltitudeOffset& body, double target_m) {
  body_ = AltitudeRamp(body);
  body_.SetTarget(target_m);
}

std::vector<FlightEvent> Avoidance::Update(const std::vector<MemberObservation>& members,
                                           const std::vector<Traffic>& strangers,
                                           const AirspaceLimits& limits, double step_s) {
  std::vector<FlightEvent> events;
  std::vector<int> heard;
  std::vector<std::pair<int, Member>> joined;
  for (const MemberObservation& seen : members) {
    if (!seen.heard) continue;
    heard.push_back(seen.id);
    if (!members_.contains(seen.id)) joined.emplace_back(seen.id, NewMember(seen, limits));
  }
  std::ranges::sort(heard);
  std::erase_if(members_, [&](const auto& entry) { return !std::ranges::binary_search(heard, entry.first); });
  members_.insert(joined.begin(), joined.end());

  for (const MemberObservation& seen : members) {
    if (seen.heard) UpdateRole(seen, members_.at(seen.id), limits, events);
  }
  ChooseBodyTarget(members, strangers, limits, events);
  AltitudeRampLimits ramp_limits;
  ramp_limits.rate_m_s = limits.climb_rate_m_s;
  body_.SetLimits(ramp_limits);
  for (auto& [id, member] : members_) {
    member.ramp.SetLimits(ramp_limits);
    if (member.role == Role::kFlying) member.ramp.SetTarget(body_.target_m());
    member.ramp.Advance(step_s);
  }
  body_.Advance(step_s);
  return events;
}

Avoidance::Member Avoidance::NewMember(const MemberObservation& seen, const AirspaceLimits& limits) const {
  // Who comes to a body that is away from its planned altitude, and is not up there with it, rejoins like one
  // that was lost. So does one that was rejoining when the controller itself was restarted.
  Member member{Role::kFlying, body_, 0};
  const bool away = body_.target_m() != 0 || !body_.settled();
  if (away && std::abs(seen.level_m - body_.now().height_m) > 0.5 * limits.clearance_m) {
    member.role = Role::kRejoining;
    member.ramp = AltitudeRamp({seen.level_m, 0, 0}, body_.limits());
    member.ramp.SetTarget(RejoinLevel(seen.id, seen.level_m, limits));
  }
  return member;
}

void Avoidance::UpdateRole(const MemberObservation& seen, Member& member, const AirspaceLimits& limits,
                           std::vector<FlightEvent>& events) {
  if (seen.lost) {
    member.role = Role::kLost;
    member.level_m = seen.level_m;
    return;
  }
  if (member.role == Role::kLost && seen.in_place &&
      std::abs(seen.level_m - body_.now().height_m) <= 0.5 * limits.clearance_m) {
    // Where it belongs, among the others, it is in nobody's way; after all were silent that is so of each.
    member.role = Role::kFlying;
    member.ramp = AltitudeRamp({seen.level_m, 0, 0}, body_.limits());
    events.push_back(
        {event_t::INFO, "rejoined", seen.id, fmt::format("{} is heard again, in place", seen.callsign)});
  }
  if (member.role == Role::kLost) {
    member.role = Role::kRejoining;
    // It comes back at the level that it has; its slot is taken there first, so that nothing jumps.
    member.ramp = AltitudeRamp({seen.level_m, 0, 0}, body_.limits());
    member.ramp.SetTarget(RejoinLevel(seen.id, seen.level_m, limits));
    events.push_back({event_t::INFO, "rejoin_started", seen.id,
                      fmt::format("{} is heard again and rejoins {} the others", seen.callsign,
                                  member.ramp.target_m() < body_.now().height_m ? "below" : "above")});
  }
  if (member.role == Role::kRejoining) {
    member.level_m = member.ramp.now().height_m;
    // The level goes with the path; the ceiling and the ground do not.
    if (limits.lowest_m < limits.highest_m) {
      member.ramp.SetTarget(std::clamp(member.ramp.target_m(), limits.lowest_m, limits.highest_m));
    }
    if (seen.ready_to_merge && member.ramp.settled() && WayToBodyIsFree(seen.id, member.level_m)) {
      member.role = Role::kFlying;
      events.push_back(
          {event_t::INFO, "rejoined", seen.id, fmt::format("{} is back in place", seen.callsign)});
    }
  }
}

bool Avoidance::WayToBodyIsFree(int id, double level_m) const {
  const double low = std::min(level_m, body_.target_m());
  const double high = std::max(level_m, body_.target_m());
  return std::none_of(members_.begin(), members_.end(), [&](const auto& entry) {
    const auto& [other_id, other] = entry;
    return other_id != id && other.role != Role::kFlying && low < other.level_m && other.level_m < high;
  });
}

double Avoidance::RejoinLevel(int id, double level_m, const AirspaceLimits& limits) const {
  // Two who rejoin at once keep apart in height too: neither of them is in place.
  const auto free = [&](double level) {
    if (level > limits.highest_m || level < limits.lowest_m) return false;
    return std::all_of(members_.begin(), members_.end(),
                       [&](const auto& entry) {
                         const auto& [other_id, other] = entry;
                         if (other_id == id || other.role == Role::kFlying) return true;
                         const double other_level =
                             other.role == Role::kRejoining ? other.ramp.target_m() : other.level_m;
                         return std::abs(level - other_level) >= 0.8 * limits.clearance_m;
                       }) &&
           std::abs(level - body_.target_m()) >= 0.8 * limits.clearance_m;
  };
  if (free(level_m)) return level_m;
  for (int step = 1; step <= 8; ++step) {
    for (const double side : {-1.0, 1.0}) {
      const double level = level_m + side * step * limits.clearance_m;
      if (free(level)) return level;
    }
  }
  return level_m;
}

void Avoidance::ChooseBodyTarget(const std::vector<MemberObservation>& members,
                                 const std::vector<Traffic>& strangers, const AirspaceLimits& limits,
                                 std::vector<FlightEvent>& events) {
  std::vector<SeparatedMember> separated;
  std::vector<Traffic> body;
  std::string who;
  bool anybody_lost = false;
  bool all_heard = true;
  for (const MemberObservation& seen : members) {
    all_heard = all_heard && seen.heard;
    if (!seen.heard) continue;
    const Member& member = members_.at(seen.id);
    if (member.role == Role::kFlying) {
      body.push_back(seen.track);
      continue;
    }
    separated.push_back({member.level_m});
    anybody_lost = anybody_lost || member.role == Role::kLost;
    who += (who.empty() ? "" : ", ") + seen.callsign;
  }
  const double before = body_.target_m();
  const bool was_blocked = blocked_;
  blocked_ = false;
  if (separated.empty()) {
    // All are in place, unless somebody has not been heard since a restart: the climb may be because of him.
    if (before != 0 && all_heard) {
      blocked_ = !FreeOfTraffic(body_.now().height_m, 0, body, strangers, limits.strangers);
      if (!blocked_) body_.SetTarget(0);
    }
  } else if (body.empty()) {
    // Nobody is left who could get out of the way.
  } else if (const auto offset =
                 ChooseOffset(body_.now().height_m, before, separated, body, strangers, limits)) {
    body_.SetTarget(*offset);
  } else {
    blocked_ = true;
  }
  if (blocked_ && !was_blocked) {
    events.push_back({event_t::WARNING, "avoidance_blocked", 0,
                      separated.empty()
                          ? "stays at its altitude: other traffic is in the way to the planned one"
                          : "no altitude is free to avoid " + who +
                                ": ceiling, ground or other traffic; stays at its altitude"});
  }
  if (body_.target_m() == before) return;
  const double change = body_.target_m() - body_.now().height_m;
  const std::string way =
      fmt::format("{} {:.0f} m", change > 0 ? "climbing" : "descending", std::abs(change));
  if (separated.empty()) {
    events.push_back(
        {event_t::INFO, "avoidance_ended", 0, way + " to the planned altitude: all are in place"});
  } else {
    events.push_back({event_t::CAUTION, "avoidance_started", 0,
                      way + ": " + (anybody_lost ? "link of " + who + " lost" : who + " rejoins")});
  }
}

}  // namespace skein::controller

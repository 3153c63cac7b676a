#include "monitor/membership.h"

#include <algorithm>

namespace skein::monitor {
namespace {

constexpr bus::Utime kForgottenAfter = 5 * bus::kSecond;  // FORMATION is repeated at 1 Hz
constexpr bus::Utime kPause =
    2 * bus::kSecond;  // between commands, after which the controller counts as gone

}  // namespace

Membership::Membership(bus::Utime now, const ProximityLimits& strangers,
                       const std::vector<KnownFormation>& formations) {
  Check(strangers);
  rules_.strangers = strangers;
  for (const KnownFormation& formation : formations) Hear(now, formation);
}

void Membership::Hear(bus::Utime now, const KnownFormation& formation) {
  Check(formation.limits);
  rules_.formations[formation.id] = formation.limits;
  Entry& entry = formations_[formation.id];
  entry.heard = now;
  if (entry.members == formation.members) return;
  entry.members = formation.members;
  Index();
}

void Membership::HearCommands(bus::Utime now) {
  if (now - last_command_ > kPause) commanding_since_ = now;
  last_command_ = now;
}

void Membership::Forget(bus::Utime now) {
  if (now - last_command_ > kPause) return;
  const auto forgotten = std::erase_if(formations_, [&](const auto& formation) {
    return now - std::max(formation.second.heard, commanding_since_) > kForgottenAfter;
  });
  if (forgotten == 0) return;
  std::erase_if(rules_.formations, [&](const auto& limits) { return !formations_.contains(limits.first); });
  Index();
}

void Membership::Index() {
  formation_of_.clear();
  for (const auto& [id, formation] : formations_) {
    for (const int member : formation.members) formation_of_.try_emplace(member, id);
  }
}

int Membership::FormationOf(int vehicle_id) const {
  const auto found = formation_of_.find(vehicle_id);
  return found == formation_of_.end() ? 0 : found->second;
}

}  // namespace skein::monitor

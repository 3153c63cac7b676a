#include "recording/fleet_table.h"

#include <algorithm>
#include <set>

namespace skein::recording {

FleetRow& FleetTable::Row(std::int32_t id) {
  const auto known = rows_.find(id);
  if (known != rows_.end()) return known->second;
  return rows_.size() < kMostRows ? rows_[id] : nobody_;
}

void FleetTable::Take(const std::vector<vehicle_info_t>& roster) {
  std::set<std::int32_t> named;
  for (const vehicle_info_t& info : roster) {
    Row(info.id).info = info;
    named.insert(info.id);
  }
  std::erase_if(rows_, [&](const auto& entry) { return !named.contains(entry.first); });
}

void FleetTable::Take(const fleet_state_t& chunk, bus::Utime now) {
  for (const vehicle_state_t& state : chunk.vehicles) {
    FleetRow& row = Row(state.id);
    row.state = state;
    row.heard_at = now;
  }
}

void FleetTable::Take(std::int32_t formation_id, const std::vector<slot_status_t>& slots) {
  const auto known = members_.find(formation_id);
  const bool same =
      known != members_.end() && std::ranges::equal(known->second, slots, {}, {}, &slot_status_t::vehicle_id);
  if (!same) {
    RemoveFormation(formation_id);
    if (slots.empty() || members_.size() >= kMostRows) return;
    std::vector<std::int32_t>& members = members_[formation_id];
    for (const slot_status_t& slot : slots) members.push_back(slot.vehicle_id);
  }
  for (const slot_status_t& slot : slots) {
    FleetRow& row = Row(slot.vehicle_id);
    row.formation_id = formation_id;
    row.slot = slot;
  }
}

bool FleetTable::Take(const proximity_t& chunk) {
  bool changed = false;
  for (const vehicle_proximity_t& near : chunk.vehicles) {
    FleetRow& row = Row(near.id);
    changed |= near.level != (row.proximity ? row.proximity->level : 0);
    row.proximity = near;
  }
  return changed;
}

bool FleetTable::Take(const link_status_t& chunk) {
  bool changed = false;
  for (const vehicle_link_t& link : chunk.links) {
    FleetRow& row = Row(link.id);
    changed |= !row.link || row.link->downlink != link.downlink || row.link->uplink != link.uplink;
    row.link = link;
  }
  return changed;
}

void FleetTable::StartAnew() {
  members_.clear();
  for (auto& [id, row] : rows_) {
    FleetRow known;
    known.info = row.info;
    row = known;
  }
}

void FleetTable::RemoveFormation(std::int32_t formation_id) {
  const auto formation = members_.find(formation_id);
  if (formation == members_.end()) return;
  for (const std::int32_t id : formation->second) {
    const auto row = rows_.find(id);
    if (row == rows_.end() || row->second.formation_id != formation_id) continue;
    row->second.formation_id = 0;
    row->second.slot.reset();
  }
  members_.erase(formation);
}

}  // namespace skein::recording

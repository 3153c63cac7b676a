#include "recording/fleet_table.h"

#include <gtest/gtest.h>

namespace skein::recording {
namespace {

std::vector<slot_status_t> Slots(const std::vector<std::int32_t>& ids, double error_m) {
  std::vector<slot_status_t> slots(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    slots[i].vehicle_id = ids[i];
    slots[i].left_error_m = error_m;
  }
  return slots;
}

std::int32_t FormationOf(const FleetTable& fleet, std::int32_t id) {
  return fleet.rows().at(id).formation_id;
}

TEST(FleetTable, WhoHasNoSlotAnyMoreHasLeftTheFormation) {
  FleetTable fleet;
  fleet.Take(1, Slots({1, 2, 3}, 5));
  fleet.Take(1, Slots({1, 2, 3}, 6));
  EXPECT_EQ(fleet.rows().at(2).slot->left_error_m, 6);
  fleet.Take(1, Slots({1, 3}, 7));
  EXPECT_EQ(FormationOf(fleet, 2), 0);
  EXPECT_FALSE(fleet.rows().at(2).slot.has_value());
  EXPECT_EQ(fleet.rows().at(3).slot->left_error_m, 7);
}

TEST(FleetTable, TheFormationThatToldLastHasTheUav) {
  FleetTable fleet;
  fleet.Take(1, Slots({1, 2}, 5));
  fleet.Take(2, Slots({2, 3}, 5));
  EXPECT_EQ(FormationOf(fleet, 2), 2);
  fleet.Take(1, Slots({1, 2}, 5));
  EXPECT_EQ(FormationOf(fleet, 2), 1);
  fleet.RemoveFormation(2);
  EXPECT_EQ(FormationOf(fleet, 2), 1);
  EXPECT_EQ(FormationOf(fleet, 3), 0);
}

TEST(FleetTable, KeepsNoMoreInventedUavsThanItHasRoomFor) {
  FleetTable fleet;
  fleet_state_t chunk{};
  chunk.vehicles.resize(1000);
  for (std::int32_t id = 1; id < 250'000;) {
    for (vehicle_state_t& vehicle : chunk.vehicles) vehicle.id = id++;
    fleet.Take(chunk, 1);
  }
  EXPECT_EQ(fleet.rows().size(), FleetTable::kMostRows);
  fleet.Take(chunk, 2);
  EXPECT_EQ(fleet.rows().size(), FleetTable::kMostRows);
  for (vehicle_state_t& vehicle : chunk.vehicles) vehicle.id = 7;
  fleet.Take(chunk, 2);
  EXPECT_EQ(fleet.rows().at(7).heard_at, 2);
}

}  // namespace
}  // namespace skein::recording

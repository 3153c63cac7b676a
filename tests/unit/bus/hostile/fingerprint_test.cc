#include <gtest/gtest.h>

#include <map>
#include <string>

#include "bus/validate.h"
#include "unit/bus/hostile/schema.h"

namespace skein::bus::testing {
namespace {

/// LCM tells types apart by a fingerprint of their fields alone: names of types do not count.
TEST(Fingerprints, AreAllDifferent) {
  std::map<std::int64_t, std::string> types;
  const auto add = [&]<typename... Message>() {
    (..., [&] {
      const auto [other, is_new] = types.emplace(Message::getHash(), Message::getTypeName());
      EXPECT_TRUE(is_new) << Message::getTypeName() << " has the fields of " << other->second;
    }());
  };
  add.operator()<ack_t, alarm_command_t, alarm_list_t, alarm_t, event_t, fleet_command_t, fleet_roster_t,
                 fleet_state_t, formation_command_t, formation_status_t, formation_t, heartbeat_t,
                 link_command_t, link_status_t, parameter_t, path_command_t, path_piece_t, path_profile_t,
                 path_t, payload_command_t, proximity_t, recording_command_t, recording_status_t,
                 simulation_command_t, slot_status_t, slot_t, vehicle_command_t, vehicle_info_t,
                 vehicle_link_t, vehicle_proximity_t, vehicle_state_t, waypoint_t>();
  EXPECT_EQ(types.size(), Schema(SKEIN_SOURCE_DIR "/lcmtypes").type_names().size())
      << "a type is missing in this test";
}

}  // namespace
}  // namespace skein::bus::testing

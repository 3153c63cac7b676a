#pragma once

#include <gtest/gtest.h>

#include "bus/validate.h"

namespace skein::bus::testing {

/// Every type that is published.
using Messages =
    ::testing::Types<ack_t, alarm_command_t, alarm_list_t, event_t, fleet_command_t, fleet_roster_t,
                     fleet_state_t, formation_command_t, formation_status_t, formation_t, heartbeat_t,
                     link_command_t, link_status_t, path_command_t, path_t, payload_command_t, proximity_t,
                     recording_command_t, recording_status_t, simulation_command_t>;

}  // namespace skein::bus::testing

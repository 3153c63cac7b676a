#pragma once

#include "bridge/json_messages.h"
#include "recording/fleet_table.h"

namespace skein::bridge {

/// The rows as /api/vehicles shows them; null for what is not known.
Json ToJson(const recording::FleetTable& fleet, bus::Utime now);

}  // namespace skein::bridge

#pragma once

#include <cstdint>

#include "bus/bus.h"

namespace skein::bus {

/// Sends HEARTBEAT once a second for as long as the executor runs. Make one for each Bus, in main; nodes need
/// not know.
/// @param receive_buffer_bytes of Transport.
void StartHeartbeat(Bus& bus, std::int64_t receive_buffer_bytes = 0);
/// Sends one now.
void SendHeartbeat(Bus& bus, std::int64_t receive_buffer_bytes);

}  // namespace skein::bus

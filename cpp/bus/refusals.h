#pragma once

#include "bus/bus.h"

namespace skein::bus {

/// Tells, as the event "message_refused", of each channel on which a message could not be used: once, however
/// many there are. HEARTBEAT counts them all.
void TellRefusals(Bus& bus);

}  // namespace skein::bus

#pragma once

#include <string>

#include "bus/bus.h"

namespace skein::bus {

/// Tells, as the event "message_refused", of each channel on which a message could not be used: once for each
/// reason, however many there are. HEARTBEAT counts them all.
void TellRefusals(Bus& bus);

/// A message is well by itself, but cannot be true. @param why after "was refused: ", one of a few texts:
/// each is remembered.
void Refuse(Bus& bus, const std::string& channel, const std::string& why);

/// Something in a message cannot be true, and another event tells of it: only counts.
void CountFlagged(Bus& bus);

}  // namespace skein::bus

#include "bus/refusals.h"

#include "bus/events.h"

namespace skein::bus {

void TellRefusals(Bus& bus) {
  bus.executor().Every(kSecond, [&bus] {
    for (const std::string& channel : bus.TakeNewlyRefused()) {
      Events(bus).Tell(event_t::ADVISORY, "message_refused",
                       "a message on " + channel +
                           " was refused: it does not decode, or holds what it must not. More of them are "
                           "only counted (HEARTBEAT)");
    }
  });
}

}  // namespace skein::bus

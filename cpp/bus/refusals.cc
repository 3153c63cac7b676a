#include "bus/refusals.h"

#include "bus/events.h"

namespace skein::bus {
namespace {

// The bus remembers what was refused by name: a channel, or a channel and why.
constexpr const char* kWhy = " was refused: ";
constexpr const char* kFlagged = "";

}  // namespace

void TellRefusals(Bus& bus) {
  bus.executor().Every(kSecond, [&bus] {
    for (std::string refused : bus.TakeNewlyRefused()) {
      if (refused == kFlagged) continue;
      if (refused.find(kWhy) == std::string::npos)
        refused += std::string(kWhy) + "it does not decode, or holds what it must not";
      Events(bus).Tell(event_t::ADVISORY, "message_refused",
                       "a message on " + refused + ". More of them are only counted (HEARTBEAT)");
    }
  });
}

void Refuse(Bus& bus, const std::string& channel, const std::string& why) {
  bus.CountRefusal(channel + kWhy + why);
}

void CountFlagged(Bus& bus) { bus.CountRefusal(kFlagged); }

}  // namespace skein::bus

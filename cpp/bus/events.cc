#include "bus/events.h"

#include <spdlog/spdlog.h>

#include "bus/channels.h"
#include "bus/text.h"

namespace skein::bus {

void Events::Tell(std::int8_t severity, const std::string& code, const std::string& text, About about) {
  event_t event;
  event.utime = bus_.executor().Now();
  event.event_node = bus_.node();
  event.event_sequence = bus_.NextEventSequence();
  event.severity = severity;
  event.code = code;
  event.vehicle_id = about.vehicle_id;
  event.formation_id = about.formation_id;
  event.text = Shortened(text);
  bus_.Publish(channel::kEvent, event);
  if (!bus_.logs()) return;
  spdlog::log(severity >= event_t::CAUTION ? spdlog::level::warn : spdlog::level::info, "{}: {}", code, text);
}

}  // namespace skein::bus

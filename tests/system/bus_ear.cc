#include "system/bus_ear.h"

#include <skein/heartbeat_t.hpp>

#include "bus/channels.h"

namespace skein::testing {

bool HearsHeartbeat(const std::string& lcm_url, const std::string& node, Seconds timeout) {
  return Hears<heartbeat_t>(
      lcm_url, bus::channel::kHeartbeat,
      [&](const heartbeat_t& heartbeat) { return heartbeat.heartbeat_node == node; }, timeout);
}

}  // namespace skein::testing

#include "monitor/clock_watch.h"

#include <spdlog/fmt/fmt.h>

#include <cstdlib>
#include <skein/heartbeat_t.hpp>

#include "bus/channels.h"

namespace skein::monitor {
namespace {

// Whoever can send HEARTBEAT can invent names.
constexpr std::size_t kMostNodes = 100;
constexpr const char* kWallClock = "wall-clock";

}  // namespace

ClockWatch::ClockWatch(bus::Bus& bus, AlarmDesk& alarms) : alarms_(alarms) {
  bus.Subscribe<heartbeat_t>(bus::channel::kHeartbeat, [this, &bus](const heartbeat_t& heartbeat) {
    Hear(heartbeat.heartbeat_node, heartbeat.utime, bus.executor().Now());
  });
  bus.executor().Every(bus::kSecond, [this, &bus] { LookAtWallClock(bus.executor().WallAhead()); });
}

void ClockWatch::LookAtWallClock(bus::Utime ahead) {
  const bool off = std::abs(ahead) > (wall_clock_alarm_ ? kMost / 2 : kMost);
  if (off == wall_clock_alarm_) return;
  wall_clock_alarm_ = off;
  if (!off) return alarms_.End(kWallClock);
  alarms_.Raise(
      {kWallClock, AlertLevel::kCaution,
       fmt::format("the clock of the monitor's host was set {} by {:.1f} s: Skein goes on in its own time "
                   "until all of it there is ended and started again",
                   ahead > 0 ? "forward" : "back", bus::ToSeconds(std::abs(ahead)))});
}

void ClockWatch::Hear(const std::string& node, bus::Utime sent, bus::Utime now) {
  const bus::Utime offset = sent - now;
  if (nodes_.size() >= kMostNodes && !nodes_.contains(node)) {
    std::erase_if(nodes_, [](const auto& known) { return !known.second.alarm; });
    if (nodes_.size() >= kMostNodes) return;
  }
  Offset& known = nodes_[node];
  const bus::Utime most = known.alarm ? kMost / 2 : kMost;
  const bool off = std::abs(offset) > most;
  if (!off) known.off_since.reset();
  if (off && !known.off_since) known.off_since = now;
  if (off == known.alarm || (off && now - *known.off_since < kOffFor)) return;
  known.alarm = off;
  const std::string key = "clock:" + node;
  if (!off) return alarms_.End(key);
  alarms_.Raise({key, AlertLevel::kCaution,
                 fmt::format("the clock of {} is {:.1f} s {} the monitor's: synchronise the hosts", node,
                             bus::ToSeconds(std::abs(offset)), offset > 0 ? "ahead of" : "behind")});
}

}  // namespace skein::monitor

#include "bus/only_one.h"

#include <spdlog/spdlog.h>

#include <map>
#include <optional>
#include <utility>

#include "bus/channels.h"
#include "bus/heartbeat.h"
#include "bus/live_executor.h"

namespace skein::bus {
namespace {

constexpr Utime kLookPeriod = kSecond / 20;
// A process that has not looked for so long was stopped, and has not read what came meanwhile.
constexpr Utime kWasStopped = kSecond / 2;
// While somebody stands by: OnlyOne::kSilence is ten of these, so that a lossy network swaps nobody.
constexpr Utime kBeat = kSecond / 4;
constexpr const char* kStandby = "-standby";
// Whoever can send HEARTBEAT can invent sessions.
constexpr std::size_t kMostKnown = 100;

/// Whether this is the first that is heard of it.
bool IsNew(std::set<std::int64_t>& known, std::int64_t session_id) {
  return known.size() < kMostKnown && known.insert(session_id).second;
}

}  // namespace

std::string StandbyOf(const std::string& node) { return node + kStandby; }
bool IsStandby(const std::string& node) { return node.ends_with(kStandby); }

bool AwaitTurn(const Transport& transport, const std::string& node) {
  LiveExecutor executor(transport.lcm);
  Bus bus(transport.lcm, StandbyOf(node), executor);
  const Utime start = executor.Now();
  std::optional<Utime> active_heard;
  std::map<std::int64_t, Utime> before_us;  // who stands by for longer than we do, and when it was heard
  std::set<std::int64_t> known;
  bool turn = false;
  bool told = false;
  bus.Subscribe<heartbeat_t>(channel::kHeartbeat, [&](const heartbeat_t& heartbeat) {
    if (heartbeat.heartbeat_node == node) active_heard = executor.Now();
    if (heartbeat.heartbeat_node != bus.node() || heartbeat.session_id == bus.session_id()) return;
    if (heartbeat.session_id < bus.session_id()) before_us[heartbeat.session_id] = executor.Now();
    if (IsNew(known, heartbeat.session_id)) SendHeartbeat(bus, transport.receive_buffer_bytes);
  });
  SendHeartbeat(bus, transport.receive_buffer_bytes);
  StartHeartbeat(bus, transport.receive_buffer_bytes);
  Utime looked = start;
  executor.Every(kLookPeriod, [&] {
    const Utime now = executor.Now();
    if (now - std::exchange(looked, now) >= kWasStopped && active_heard) active_heard = now;
    std::erase_if(before_us, [&](const auto& entry) { return now - entry.second >= OnlyOne::kSilence; });
    const bool active = active_heard && now - *active_heard < OnlyOne::kSilence;
    if (active && !told) {
      spdlog::warn("another {} runs on this bus: stands by, and takes over when that one falls silent", node);
      told = true;
    }
    if (active || !before_us.empty() || now - start < OnlyOne::kListen) return;
    if (told)
      spdlog::warn("the other {} has been silent for {:.1f} s: takes over", node,
                   ToSeconds(now - active_heard.value_or(now)));
    turn = true;
    executor.Stop();
  });
  executor.Run();
  return turn;
}

Turn::Turn(Bus& bus, std::int64_t receive_buffer_bytes, std::function<void()> end) {
  bus.Subscribe<heartbeat_t>(channel::kHeartbeat, [this, &bus, receive_buffer_bytes,
                                                   end = std::move(end)](const heartbeat_t& heartbeat) {
    if (heartbeat.session_id == bus.session_id()) return;
    const bool same = heartbeat.heartbeat_node == bus.node();
    if (same && heartbeat.session_id > bus.session_id()) {
      if (heartbeat.session_id != later_) later_beat_ = heartbeat.utime;
      later_ = heartbeat.session_id;
      over_ = heartbeat.utime - later_beat_ >= OnlyOne::kProof;
      if (over_) end();
      return;
    }
    const bool stands_by = heartbeat.heartbeat_node == StandbyOf(bus.node());
    if (stands_by) standby_heard_ = bus.executor().Now();
    if ((same || stands_by) && IsNew(known_, heartbeat.session_id)) SendHeartbeat(bus, receive_buffer_bytes);
  });
  bus.executor().Every(kBeat, [this, &bus, receive_buffer_bytes] {
    const bool stands_by = standby_heard_ && bus.executor().Now() - *standby_heard_ < 2 * OnlyOne::kSilence;
    if (stands_by && !over_) SendHeartbeat(bus, receive_buffer_bytes);
  });
  SendHeartbeat(bus, receive_buffer_bytes);
}

}  // namespace skein::bus

#include "monitor/silence_watch.h"

#include <spdlog/fmt/fmt.h>

#include <skein/heartbeat_t.hpp>

#include "bus/channels.h"
#include "bus/only_one.h"

namespace skein::monitor {
namespace {

constexpr bus::Utime kLookPeriod = bus::kSecond / 2;
constexpr bus::Utime kSilentAfter = 3 * bus::kSecond;  // three heartbeats
// Heard so often a node is one: a damaged name comes once.
constexpr int kKnown = 3;
constexpr std::string_view kNodeSilent = "node_silent:";
constexpr const char* kController = "formation-controller";
// Whoever can send HEARTBEAT can invent names.
constexpr std::size_t kMostNodes = 100;

AlarmCondition NodeSilent(const std::string& node) {
  const bool steers = node == kController;
  return {std::string(kNodeSilent) + node, steers ? AlertLevel::kWarning : AlertLevel::kCaution,
          fmt::format("{} has fallen silent{}", node, steers ? ": nobody steers the formations" : "")};
}

}  // namespace

SilenceWatch::SilenceWatch(bus::Bus& bus, AlarmDesk& alarms) : bus_(bus), alarms_(alarms) {
  bus.Subscribe<heartbeat_t>(bus::channel::kHeartbeat, [this](const heartbeat_t& heartbeat) {
    const std::string& node = heartbeat.heartbeat_node;
    if (bus::IsStandby(node)) return;
    if (nodes_.size() >= kMostNodes && !nodes_.contains(node)) return;
    nodes_[node].heard = bus_.executor().Now();
    ++nodes_[node].times;
  });
  // Who was silent before this process was started anew is so until it is heard.
  for (const std::string& key : alarms.unconfirmed()) {
    if (key.starts_with(kNodeSilent)) nodes_[key.substr(kNodeSilent.size())] = {0, kKnown};
  }
  bus.executor().Every(kLookPeriod, [this] { Look(); });
}

void SilenceWatch::Look() {
  const bus::Utime now = bus_.executor().Now();
  if (held_up_.MustListen(now)) return;
  std::erase_if(nodes_, [now](const auto& node) {
    return node.second.times < kKnown && now - node.second.heard >= kSilentAfter;
  });
  for (const auto& [node, last] : nodes_) {
    const AlarmCondition silence = NodeSilent(node);
    if (now - last.heard >= kSilentAfter) {
      alarms_.Raise(silence);
    } else {
      alarms_.End(silence.key);
    }
  }
}

}  // namespace skein::monitor

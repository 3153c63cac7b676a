#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "bus/bus.h"
#include "bus/transport.h"

namespace skein::bus {

/// Of some nodes there is to be one alone on a bus: two simulators of a fleet, or two controllers that
/// command it, would work against one another. One that is started while another runs stands by, and takes
/// over when that one has been silent for kSilence; while it does, that one beats four times a second. All by
/// HEARTBEAT: who stands by is called "NODE-standby" in it, and whoever hears of a newcomer tells him at once
/// that he is there himself.
///
/// Nothing but a network that was cut in two, or a process that was stopped for seconds, lets two run at
/// once. When they hear of one another the older one ends. A simulator obeys the newest controller alone, so
/// even then no UAV hears two.
struct OnlyOne {
  /// So long a newcomer listens for others before it takes its turn.
  static constexpr Utime kListen = kSecond / 5;
  static constexpr Utime kSilence = 5 * kSecond / 2;
  /// A later one is believed when a second heartbeat is so much younger than its first: not for one false
  /// message, however often it comes.
  static constexpr Utime kProof = kSecond / 2;
};

/// The name in HEARTBEAT of a node that stands by, and whether a name is one. Nobody misses it when it falls
/// silent.
std::string StandbyOf(const std::string& node);
bool IsStandby(const std::string& node);

/// Waits until nobody of that name is on the bus. @return false when this process is asked to end instead.
bool AwaitTurn(const Transport& transport, const std::string& node);

/// To be had for as long as a node runs that has awaited its turn.
class Turn {
 public:
  /// @param bus of the node; outlives this. @param end called when another one has taken over.
  Turn(Bus& bus, std::int64_t receive_buffer_bytes, std::function<void()> end);

  bool over() const { return over_; }

 private:
  bool over_ = false;
  std::int64_t later_ = 0;  ///< session of a later one
  std::optional<Utime> standby_heard_;
  Utime later_beat_ = 0;          ///< time stamp of its first heartbeat that was heard
  std::set<std::int64_t> known_;  ///< sessions of others that have been told of this one
};

}  // namespace skein::bus

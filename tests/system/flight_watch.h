#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bus/bus.h"
#include "bus/live_executor.h"
#include "bus/transport.h"
#include "system/flight_judge.h"
#include "system/process.h"

namespace skein::testing {

/// Waits until it is so, at most `timeout`. @return whether it is, and after how long [s].
std::pair<bool, double> Await(const std::function<bool()>& is_so, Seconds timeout);

/// Listens to a flight of one formation in a thread of its own, and knows what was heard last.
class FlightWatch {
 public:
  /// @param judge hears all that it needs; outlives this.
  FlightWatch(const std::string& lcm_url, FlightJudge& judge);
  ~FlightWatch();
  FlightWatch(const FlightWatch&) = delete;
  FlightWatch& operator=(const FlightWatch&) = delete;

  /// A node that was there and is silent since: an alarm that stays.
  static constexpr const char* kSilentNode = "payload-computer";
  void BeASilentNode();

  /// All starts of fleets that were heard of, by the roster.
  std::set<std::int64_t> flights() const;
  /// The tick that was heard last.
  bus::Utime now() const;
  bool IsHeard(int vehicle_id) const;
  /// As repeated last, without its time stamp.
  formation_t formation() const;
  path_t path() const;
  formation_status_t status() const;
  /// The newest run of a node, 0: never heard.
  std::int64_t session(const std::string& node) const;
  /// The alarm about that condition in the last list that is younger than `since`.
  std::optional<alarm_t> Alarm(const std::string& condition, bus::Utime since = 0) const;
  /// How far UAVs are from where the controller says that their slots are, by their own telemetry of the same
  /// tick: the farthest [m]. Infinite when one is not heard, or nothing younger than `since` is known.
  double FarthestFromSlot(bus::Utime since = 0) const;
  std::vector<std::string> wrong() const;
  std::string closest() const;
  void ExpectOtherPath();

 private:
  void Hear(const formation_status_t& status);

  bus::Transport transport_;
  bus::LiveExecutor executor_;
  bus::Bus bus_{transport_.lcm, "system-test", executor_};
  FlightJudge& judge_;
  mutable std::mutex mutex_;
  std::set<std::int64_t> flights_;
  std::map<std::int64_t, fleet_state_t> states_;  ///< the last ones, by tick
  std::map<std::string, std::int64_t> sessions_;
  alarm_list_t alarms_{};
  formation_t formation_{};
  path_t path_{};
  formation_status_t status_{};
  double farthest_m_ = 0;  ///< at status_
  int beats_ = 0;          ///< heartbeats that the silent node still sends
  std::thread thread_;
};

/// Whether two messages say the same.
template <typename Message>
bool Same(const Message& one, const Message& other) {
  const auto bytes = [](const Message& message) {
    std::vector<char> encoded(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
    return encoded;
  };
  return bytes(one) == bytes(other);
}

}  // namespace skein::testing

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bus/executor.h"
#include "core/link_watch.h"
#include "monitor/watched_uav.h"

namespace skein::monitor {

/// When each UAV was last heard before this process was started anew: a link that breaks just before a
/// restart is to be found in the same 5 s as any other.
class LinkMemory {
 public:
  /// @param saved what Encode returned before the restart; empty: nothing. Times that lie in the future, for
  /// the clock was set, are forgotten.
  LinkMemory(std::string_view saved, bus::Utime now);

  bool empty() const { return links_.empty(); }

  /// What is remembered of a UAV of this session of the fleet, once; none: nothing.
  std::optional<LinkWatch::Memory> Take(std::int64_t session_id, int id);

  /// To be saved: what is known of the UAVs that are watched, and what is remembered of others.
  /// @param session_id of the fleet, 0: it was not heard yet.
  std::string Encode(bus::Utime now, std::int64_t session_id, const std::map<int, WatchedUav>& uavs) const;

 private:
  std::int64_t session_id_ = 0;
  std::map<int, LinkWatch::Memory> links_;  ///< by UAV
};

}  // namespace skein::monitor

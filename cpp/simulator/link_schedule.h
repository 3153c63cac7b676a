#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bus/executor.h"
#include "config/scenario.h"
#include "simulator/simulated_vehicle.h"

namespace skein::simulator {

/// A change to the data link of one UAV. What is empty stays as it is.
struct LinkChange {
  struct Direction {
    std::optional<LinkMode> mode;
    std::optional<config::LinkQuality> quality;
    bool as_at_start = false;  ///< mode and quality are those that it began with; the others don't count
  };
  int vehicle_id = 0;
  std::optional<Direction> uplink;
  std::optional<Direction> downlink;
  double duration_s =
      0;  ///< afterwards each direction is as it was, unless changed again meanwhile; 0: for good
};

/// Changes data links when their time has come: the timeline of a scenario, and what operators ask for.
class LinkSchedule {
 public:
  /// Told of each change that was made, in words and with its code for EVENT.
  using Tell =
      std::function<void(const SimulatedVehicle& vehicle, const std::string& code, const std::string& text)>;

  /// @param fleet to be changed; outlives this.
  LinkSchedule(std::vector<SimulatedVehicle>& fleet, Tell tell);

  /// @param when a time in the past means at once. @return false when there is no such UAV.
  bool Add(const LinkChange& change, bus::Utime now, bus::Utime when);

  /// Everything in a timeline; again every `repeat_s` when that is above 0.
  void AddTimeline(const std::vector<config::TimelineEntry>& timeline, bus::Utime start, double repeat_s);

  /// Makes all changes that are due, that moment included.
  void RunUntil(bus::Utime now);

 private:
  /// Of the two directions; empty: not to be touched.
  struct Settings {
    std::optional<LinkSetting> uplink;
    std::optional<LinkSetting> downlink;
  };
  /// As a UAV's link was when this was made.
  struct AtStart {
    LinkSetting uplink;
    LinkSetting downlink;
  };
  /// The number of the last change to each direction.
  struct LastChange {
    std::int64_t uplink = 0;
    std::int64_t downlink = 0;
  };

  void Make(std::size_t index, const LinkChange& change, bus::Utime now);
  void Set(std::size_t index, const Settings& settings);
  void Repeat(const LinkChange& change, bus::Utime when, bus::Utime period);

  std::vector<SimulatedVehicle>& fleet_;
  Tell tell_;
  std::map<int, std::size_t> index_;
  std::vector<AtStart> at_start_;         ///< as fleet_
  std::vector<LastChange> last_changes_;  ///< as fleet_
  std::int64_t changes_ = 0;
  std::multimap<bus::Utime, std::function<void(bus::Utime now)>> due_;
};

/// The change that a timeline entry asks for.
LinkChange ToLinkChange(const config::TimelineEntry& entry);

}  // namespace skein::simulator

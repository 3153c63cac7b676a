#pragma once

#include <optional>
#include <skein/event_t.hpp>
#include <string>
#include <vector>

#include "config/scenario.h"
#include "experiment/tick.h"

namespace skein::experiment {

/// From when on an error stayed within its band, up to the first cut of a link or, with none, the end; none:
/// it did not.
struct Settling {
  static constexpr double kPositionM = 10;
  static constexpr double kSpeedMS = 1;
  std::optional<double> forward_s;
  std::optional<double> left_s;
  std::optional<double> up_s;
  std::optional<double> speed_s;  ///< against the speed of its slot
};

/// Within Settling::kPositionM on every axis.
bool InSlot(const slot_status_t& slot);

struct VehicleSummary {
  int id = 0;
  std::string callsign;
  bool in_formation = false;
  Settling settling;
  double least_speed_m_s = 0;
  double greatest_speed_m_s = 0;
  double greatest_error_m = 0;  ///< distance from its slot
  int highest_level = 0;
  double highest_level_s = 0;  ///< when it was first reached
  int highest_level_with_id = 0;
};

/// How near two UAVs truly came.
struct Approach {
  int first_id = 0;
  int second_id = 0;
  double distance_m = 0;
  double horizontal_m = 0;
  double vertical_m = 0;
  double t_s = 0;
};

/// A cut of a data link, and what became of it.
struct LinkDrop {
  int vehicle_id = 0;
  bool uplink = false;
  bool downlink = false;
  double cut_s = 0;
  bool told_lost_before = false;     ///< and ever since: that is of an earlier one
  std::optional<double> found_s;     ///< the monitor tells it lost
  std::optional<double> restored_s;  ///< in truth
  std::optional<double> seen_up_s;   ///< the monitor tells it up again
  std::optional<double> in_slot_s;   ///< within Settling::kPositionM on every axis for good, after that
};

struct TimedEvent {
  double t_s = 0;
  event_t event;
};

/// What a flight was like.
struct Summary {
  std::string scenario;
  std::string control;  ///< of all formations, "skein, paper" when they differ, "" without any
  double duration_s = 0;
  std::vector<VehicleSummary> vehicles;
  std::vector<Approach> approaches;  ///< of every pair up to ten UAVs, else the nearest one alone
  std::vector<LinkDrop> drops;
  std::vector<TimedEvent> events;
};

/// Watches a flight.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(const config::Scenario& scenario);
  void Add(const Tick& tick);
  Summary Finish() const { return summary_; }

 private:
  void WatchErrors(const Tick& tick, std::size_t index);
  void WatchLink(const VehicleTick& vehicle, double t_s);
  void WatchDistances(const Tick& tick);

  Summary summary_;
  std::vector<std::optional<slot_status_t>> last_slots_;  ///< as summary_.vehicles
  std::int64_t ticks_between_distances_ = 1;
  double last_t_s_ = 0;
};

/// As text for people, several lines.
std::string ToText(const Summary& summary);

}  // namespace skein::experiment

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/proximity_t.hpp>
#include <vector>

#include "bus/executor.h"

namespace skein::recording {

/// All that the bus has said of one UAV.
struct FleetRow {
  std::optional<vehicle_info_t> info;
  std::optional<vehicle_state_t> state;
  bus::Utime heard_at = 0;  ///< when `state` came in, on the clock of who keeps the table
  std::int32_t formation_id = 0;
  std::optional<slot_status_t> slot;
  std::optional<vehicle_proximity_t> proximity;
  std::optional<vehicle_link_t> link;
};

/// The fleet as the bus last told it, a row per UAV, in order of id.
class FleetTable {
 public:
  /// A whole roster, its chunks put together. UAVs that it does not name are forgotten.
  void Take(const std::vector<vehicle_info_t>& roster);
  void Take(const fleet_state_t& chunk, bus::Utime now);
  /// A whole status; UAVs that have no slot in it any more leave the formation.
  void Take(std::int32_t formation_id, const std::vector<slot_status_t>& slots);
  /// True when a level has changed.
  bool Take(const proximity_t& chunk);
  /// True when the state of a link has changed.
  bool Take(const link_status_t& chunk);

  /// Forgets what was said of UAVs but not who they are: another flight begins.
  void StartAnew();
  void RemoveFormation(std::int32_t formation_id);

  const std::map<std::int32_t, FleetRow>& rows() const { return rows_; }

  /// Who can send, or write a log, can invent UAVs: more than these are not kept.
  static constexpr std::size_t kMostRows = 200'000;

 private:
  FleetRow& Row(std::int32_t id);

  std::map<std::int32_t, FleetRow> rows_;
  FleetRow nobody_;                                            ///< stands for those that are too many
  std::map<std::int32_t, std::vector<std::int32_t>> members_;  ///< of each formation, as it told last
};

}  // namespace skein::recording

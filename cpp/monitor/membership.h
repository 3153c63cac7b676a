#pragma once

#include <map>
#include <vector>

#include "bus/executor.h"
#include "core/proximity.h"

namespace skein::monitor {

/// A formation as far as proximity is concerned.
struct KnownFormation {
  int id = 0;                ///< 1 or more
  std::vector<int> members;  ///< ids of UAVs
  ProximityLimits limits;    ///< between them
};

/// Who flies with whom. A formation is known from the scenario file until FORMATION says more, and forgotten
/// when it is no longer repeated although its controller is at work. While there is no controller nothing is
/// forgotten: its UAVs still fly side by side, and must not become strangers, 500 m apart, because a process
/// died.
class Membership {
 public:
  /// @param formations of the scenario file.
  Membership(bus::Utime now, const ProximityLimits& strangers, const std::vector<KnownFormation>& formations);

  /// FORMATION was heard.
  void Hear(bus::Utime now, const KnownFormation& formation);
  /// CMD_FLEET was heard: the controller is at work.
  void HearCommands(bus::Utime now);
  /// To be called now and then.
  void Forget(bus::Utime now);

  /// The formation that a UAV is a member of; 0: none. Should it be in two, the smaller id.
  int FormationOf(int vehicle_id) const;
  const ProximityRules& rules() const { return rules_; }

 private:
  struct Entry {
    std::vector<int> members;
    bus::Utime heard = 0;
  };

  void Index();

  ProximityRules rules_;
  std::map<int, Entry> formations_;
  std::map<int, int> formation_of_;  ///< by UAV
  bus::Utime commanding_since_ = 0;  ///< without a pause
  bus::Utime last_command_ = 0;
};

}  // namespace skein::monitor

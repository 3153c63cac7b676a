#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/proximity.h"
#include "core/vehicle.h"
#include "experiment/tick.h"

namespace skein::experiment {

/// How near two UAVs come to one another's cylinder.
struct CylinderApproach {
  int first_id = 0;
  int second_id = 0;
  double horizontal_m = 0;
  double vertical_m = 0;
  double t_s = 0;
  /// The larger of horizontal distance over R and vertical distance over H; below 1 is inside the cylinder.
  double cylinders = 0;

  bool inside() const { return cylinders < 1; }
};

/// For pairs with a UAV that matters: the moment at which each pair is nearest to its cylinder, that is, at
/// which `cylinders` is least.
class CylinderWatch {
 public:
  /// @param matters ids of UAVs. @param formation_of by id; none: of no formation. @param unknown ids of UAVs
  /// that have no place.
  CylinderWatch(std::set<int> matters, std::map<int, int> formation_of, ProximityRules rules,
                std::set<int> unknown);

  void Add(const Tick& tick, double t_s);

  /// The worst first, at most `most`. Beyond 5,000 pairs only the worst one is known.
  std::vector<CylinderApproach> Worst(std::size_t most) const;

 private:
  struct Other {
    std::size_t index;  ///< in the tick
    double radius_m;
    double height_m;
  };
  struct Row {
    std::size_t index;
    std::vector<Other> others;
  };
  void MakeRows(const Tick& tick);

  std::set<int> matters_;
  std::map<int, int> formation_of_;
  ProximityRules rules_;
  std::set<int> unknown_;
  std::vector<Row> rows_;
  std::size_t pairs_ = 0;
  std::int64_t ticks_between_looks_ = 1;
  std::vector<CylinderApproach> approaches_;
};

/// Since when all UAVs of a formation that are flown have been in their slots, within Settling::kPositionM,
/// and the formation at the altitude that it wants.
class SlotWatch {
 public:
  explicit SlotWatch(int formation_id) : formation_id_(formation_id) {}
  void Add(const Tick& tick, double t_s);
  /// None: somebody is not, or nobody is flown.
  std::optional<double> settled_since_s() const { return since_s_; }

 private:
  int formation_id_;
  std::optional<double> since_s_;
};

/// Something that a UAV could not do any more of on its way to its slot.
struct BindingLimit {
  int vehicle_id = 0;
  std::string limit;   ///< "min_speed", "max_speed", "acceleration", "course_rate", "climb", "climb_rate"
  double t_s = 0;      ///< when it first was so
  double seconds = 0;  ///< for how long in all
};

/// Which envelopes keep UAVs out of their slots: a UAV is more than Settling::kPositionM out of its slot and
/// at a limit.
class LimitWatch {
 public:
  explicit LimitWatch(std::map<int, VehicleModel> models) : models_(std::move(models)) {}
  void Add(const Tick& tick, double t_s, double step_s);
  /// Those that held for half a second at least, the longest first.
  std::vector<BindingLimit> Binding() const;

 private:
  std::map<int, VehicleModel> models_;  ///< of those that matter
  std::map<std::pair<int, std::string>, BindingLimit> found_;
};

}  // namespace skein::experiment

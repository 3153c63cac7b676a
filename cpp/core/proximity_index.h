#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/proximity.h"
#include "core/proximity_lanes.h"

namespace skein {

/// A fleet in boxes within boxes, for finding out who matters to whom without looking at many. UAVs are
/// sorted along a curve that keeps neighbours together (Z-order); eight of them are a leaf, eight leaves a
/// box, eight boxes a larger one. Each box bounds the positions and the velocities within, so that a search
/// leaves out what is too far away, or closes too slowly for how far it is. A leaf searches for its eight
/// together, the nearest boxes first.
///
/// Takes one fleet after the other and keeps its buffers. Large fleets are searched by all processors.
class ProximityIndex {
 public:
  /// @param fleet of up to 16 million; it and @param rules must outlive what is asked of the index.
  void Load(const std::vector<Traffic>& fleet, const ProximityRules& rules);

  const std::vector<Traffic>& fleet() const { return *fleet_; }
  const ProximityRules& rules() const { return *rules_; }

  /// Nearest other and least Tau of every UAV, in the order of the fleet; good until the index is asked anew.
  const std::vector<VehicleProximity>& FindProximity();

  /// Places in the fleet (first < second, in order) of the pairs for which `holds` is true. It is asked for
  /// every pair that is inside the cylinder or within the advisory Tau, with the cylinder and D_mod as wide
  /// as uncertainty makes them, and for some others, by several threads at once.
  std::vector<std::pair<int, int>> FindPairs(const std::function<bool(int first, int second)>& holds) const;

 private:
  template <typename Look>
  class Search;
  struct Box {
    std::array<double, 3> low, high, velocity_low, velocity_high;
    double group;  ///< as of EightBoxes
    void Include(const Box& other);
  };

  void SortAlongCurve();
  void FillLeaf(std::size_t leaf);  ///< and its box
  void FillLevels();
  double GroupOf(int formation_id) const;
  int PlaceOf(std::size_t leaf, std::size_t lane) const;
  /// How many of eight are in use: of the last ones there may be fewer.
  static std::size_t InUse(std::size_t eight, std::size_t total) {
    return std::min(kLanes, total - eight * kLanes);
  }
  const ProximityLimits& LimitsBetween(double group, double other_group) const;
  /// Calls work(from, to) for one or several parts of the leaves, on all processors where that pays.
  void ForAllLeaves(const std::function<void(std::size_t from, std::size_t to)>& work) const;
  template <typename ReachOf>
  EightLookers LookersOf(std::size_t leaf, const ReachOf& reach_of) const;

  const std::vector<Traffic>* fleet_ = nullptr;
  const ProximityRules* rules_ = nullptr;
  std::vector<int> formation_ids_;              ///< with limits of their own, rising: groups 1, 2, ...
  std::vector<const ProximityLimits*> limits_;  ///< by group; 0: strangers

  std::vector<std::uint64_t> along_curve_;  ///< steps along it, and in the lower bits the place in the fleet
  std::vector<EightUavs> leaves_;
  std::vector<Box> boxes_;  ///< of the leaves; then, while they are built, of the level above
  std::vector<std::vector<EightBoxes>> levels_;  ///< from the boxes of leaves up to the eight that hold all
  std::vector<VehicleProximity> found_;
};

}  // namespace skein

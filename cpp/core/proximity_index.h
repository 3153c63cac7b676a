#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/proximity.h"
#include "core/proximity_lanes.h"

namespace skein {

/// A fleet in boxes within boxes, for finding the nearest other and the least Tau of each without looking at
/// many. UAVs are sorted along a curve that keeps neighbours together (Z-order), eight of them are a leaf,
/// eight leaves a box, eight boxes a larger one. Each box bounds the positions and the velocities within, so
/// that a search leaves out what is too far away, or closes too slowly for how far it is. Eight are looked at
/// together.
class ProximityIndex {
 public:
  /// @param fleet and @param rules must outlive the index.
  ProximityIndex(const std::vector<Traffic>& fleet, const ProximityRules& rules);

  /// In the order of the fleet. On several processors where that pays.
  std::vector<VehicleProximity> Find() const;

 private:
  struct Box;
  struct Best;

  void Sort();
  void Build();
  double GroupOf(int formation_id);
  Looker LookerOf(std::size_t leaf, std::size_t lane) const;
  VehicleProximity FindOne(std::size_t leaf, std::size_t lane) const;
  void LookAtLeaf(std::size_t leaf, const Looker& looker, int self, Best& best) const;
  /// The lanes of a leaf, or children of a box, that are in use: the last one may have fewer than eight.
  static std::size_t InUse(std::size_t index, std::size_t total);

  const std::vector<Traffic>& fleet_;
  const ProximityRules& rules_;
  TauLimits strangers_;
  std::vector<TauLimits> groups_;  ///< of formations that have limits; number 1 is the first
  std::pair<int, double> last_group_{0, 0};

  std::vector<int> places_;  ///< in the fleet, in the order of the curve
  std::vector<EightUavs> leaves_;
  std::vector<std::vector<EightBoxes>> levels_;  ///< from those that hold leaves up to the one that holds all
};

}  // namespace skein

#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "core/proximity.h"

namespace skein {

/// A fleet sorted into boxes within boxes, by position. Each box also bounds the velocities within, which is
/// what lets a search for the least Tau leave whole boxes out: far away and closing slowly, or not closing at
/// all. Halving at the median keeps it flat whether the fleet is spread out, clustered, or all at one point.
///
/// All bounds are exact in floating point as well (rounding is monotonic, and they are computed in the order
/// in which MotionBetween computes), so that a search that prunes only what is strictly worse finds ties too.
class ProximityTree {
 public:
  struct Range {
    Eigen::Vector3d low{0, 0, 0};
    Eigen::Vector3d high{0, 0, 0};
  };
  struct Box {
    Range position;
    Range velocity;
    int begin = 0;  ///< members are order_[begin, end)
    int end = 0;
    int left = -1;  ///< child boxes; -1: a leaf
    int right = -1;
  };

  /// @param fleet must outlive the tree.
  explicit ProximityTree(const std::vector<Traffic>& fleet);

  /// Calls visit(i) for the place in the fleet of everyone in every box whose lower_bound(box) is at most
  /// limit(), which may fall on the way. Nearer boxes (by that bound) come first. An infinite bound leaves a
  /// box out.
  template <typename LowerBound, typename Limit, typename Visit>
  void Search(const LowerBound& lower_bound, const Limit& limit, const Visit& visit) const {
    if (!boxes_.empty()) SearchBox(0, lower_bound, limit, visit);
  }

 private:
  int Build(int begin, int end);

  template <typename LowerBound, typename Limit, typename Visit>
  void SearchBox(int index, const LowerBound& lower_bound, const Limit& limit, const Visit& visit) const;

  const std::vector<Traffic>& fleet_;
  std::vector<int> order_;
  std::vector<Box> boxes_;  ///< the first one holds all
};

/// Least distances from a point to a box.
double LeastRange(const Eigen::Vector3d& point, const ProximityTree::Range& box);
Separation LeastSeparation(const Eigen::Vector3d& point, const ProximityTree::Range& box);

/// No Tau from `uav` to anyone in the box is less than this; infinite when nobody in it closes. `d_mod_m` and
/// `min_closing_m_s` are the largest of all pairs'.
double LeastTauBound(const Traffic& uav, const ProximityTree::Box& box, double d_mod_m,
                     double min_closing_m_s);

template <typename LowerBound, typename Limit, typename Visit>
void ProximityTree::SearchBox(int index, const LowerBound& lower_bound, const Limit& limit,
                              const Visit& visit) const {
  const Box& box = boxes_[index];
  if (box.left < 0) {
    for (int i = box.begin; i < box.end; ++i) visit(order_[i]);
    return;
  }
  int near = box.left;
  int far = box.right;
  double near_bound = lower_bound(boxes_[near]);
  double far_bound = lower_bound(boxes_[far]);
  if (far_bound < near_bound) {
    std::swap(near, far);
    std::swap(near_bound, far_bound);
  }
  constexpr double kNobody = std::numeric_limits<double>::infinity();
  if (near_bound < kNobody && near_bound <= limit()) SearchBox(near, lower_bound, limit, visit);
  if (far_bound < kNobody && far_bound <= limit()) SearchBox(far, lower_bound, limit, visit);
}

}  // namespace skein

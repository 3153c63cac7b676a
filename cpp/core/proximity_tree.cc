#include "core/proximity_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/alert_levels.h"

namespace skein {
namespace {

constexpr int kLeafSize = 8;
constexpr double kNobody = std::numeric_limits<double>::infinity();

double Gap(double value, double low, double high) {
  return value < low ? low - value : value > high ? value - high : 0;
}

}  // namespace

ProximityTree::ProximityTree(const std::vector<Traffic>& fleet) : fleet_(fleet), order_(fleet.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!fleet.empty()) Build(0, static_cast<int>(fleet.size()));
}

int ProximityTree::Build(int begin, int end) {
  const int index = static_cast<int>(boxes_.size());
  Box box;
  box.begin = begin;
  box.end = end;
  const Traffic& first = fleet_[order_[begin]];
  box.position = {first.position, first.position};
  box.velocity = {first.velocity, first.velocity};
  for (int i = begin + 1; i < end; ++i) {
    const Traffic& uav = fleet_[order_[i]];
    box.position.low = box.position.low.cwiseMin(uav.position);
    box.position.high = box.position.high.cwiseMax(uav.position);
    box.velocity.low = box.velocity.low.cwiseMin(uav.velocity);
    box.velocity.high = box.velocity.high.cwiseMax(uav.velocity);
  }
  boxes_.push_back(box);
  if (end - begin <= kLeafSize) return index;

  Eigen::Index axis = 0;
  (box.position.high - box.position.low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](int one, int other) { return fleet_[one].position[axis] < fleet_[other].position[axis]; });
  const int left = Build(begin, middle);
  const int right = Build(middle, end);
  boxes_[index].left = left;
  boxes_[index].right = right;
  return index;
}

double LeastRange(const Eigen::Vector3d& point, const ProximityTree::Range& box) {
  const double x = Gap(point.x(), box.low.x(), box.high.x());
  const double y = Gap(point.y(), box.low.y(), box.high.y());
  const double z = Gap(point.z(), box.low.z(), box.high.z());
  return std::sqrt(x * x + y * y + z * z);
}

Separation LeastSeparation(const Eigen::Vector3d& point, const ProximityTree::Range& box) {
  const double x = Gap(point.x(), box.low.x(), box.high.x());
  const double y = Gap(point.y(), box.low.y(), box.high.y());
  return {std::sqrt(x * x + y * y), Gap(point.z(), box.low.z(), box.high.z())};
}

double LeastTauBound(const Traffic& uav, const ProximityTree::Box& box, double d_mod_m,
                     double min_closing_m_s) {
  const double range_m = LeastRange(uav.position, box.position);
  if (range_m == 0) return 0;

  // Interval arithmetic on r . w: its least value over the box gives the largest closing rate.
  double least_product[3];
  double speed_squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double r_low = box.position.low[axis] - uav.position[axis];
    const double r_high = box.position.high[axis] - uav.position[axis];
    const double w_low = box.velocity.low[axis] - uav.velocity[axis];
    const double w_high = box.velocity.high[axis] - uav.velocity[axis];
    least_product[axis] = std::min({r_low * w_low, r_low * w_high, r_high * w_low, r_high * w_high});
    speed_squared += std::max(w_low * w_low, w_high * w_high);
  }
  const double product = -(least_product[0] + least_product[1] + least_product[2]);
  if (product <= 0) return kNobody;

  // Nobody closes faster than the relative speed either; rounding may break that law by a hair, hence the
  // hair.
  constexpr double kHair = 1 + 1e-12;
  const double closing_m_s = std::min(product / range_m, std::sqrt(speed_squared) * kHair);
  if (range_m <= d_mod_m) return 0;
  return (range_m - d_mod_m * d_mod_m / range_m) / std::max(closing_m_s, min_closing_m_s);
}

std::vector<std::pair<int, int>> FindConflictsByTree(const std::vector<Traffic>& fleet,
                                                     const ProximityRules& rules) {
  // Every cylinder as large as the widest limits and the most uncertain pair could make it.
  ProximityLimits widest = rules.Widest();
  double horizontal_m = 0;
  double vertical_m = 0;
  for (const Traffic& uav : fleet) {
    horizontal_m = std::max(horizontal_m, uav.horizontal_uncertainty_m);
    vertical_m = std::max(vertical_m, uav.vertical_uncertainty_m);
  }
  widest.radius_m += 2 * horizontal_m;
  widest.height_m += 2 * vertical_m;
  widest.d_mod_m += 2 * horizontal_m;

  const ProximityTree tree(fleet);
  std::vector<std::pair<int, int>> result;
  for (int i = 0; i < static_cast<int>(fleet.size()); ++i) {
    const Traffic& self = fleet[i];
    tree.Search(
        [&](const ProximityTree::Box& box) {
          const Separation least = LeastSeparation(self.position, box.position);
          if (least.horizontal_m < widest.radius_m && least.vertical_m < widest.height_m) return 0.0;
          return LeastTauBound(self, box, widest.d_mod_m, widest.min_closing_m_s);
        },
        [&] { return widest.advisory_tau_s; },
        [&](int j) {
          if (j <= i || Assess(self, fleet[j], rules.Between(self, fleet[j])) == AlertLevel::kClear) return;
          result.emplace_back(i, j);
        });
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace skein

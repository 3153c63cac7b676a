#include "core/proximity_index.h"

#include <algorithm>
#include <array>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <limits>
#include <thread>

namespace skein {
namespace {

constexpr double kNotInUse = std::numeric_limits<double>::quiet_NaN();
/// Fleets from this size on are searched by all processors: below it, a thread costs more than it takes over.
constexpr std::size_t kParallelFrom = 4096;
/// Of the curve, along each axis; the bits of a place in the fleet come below.
constexpr int kCurveBits = 20;
constexpr int kPlaceBits = 24;
constexpr std::uint64_t kPlaceMask = (1 << kPlaceBits) - 1;

/// How far along Hilbert's curve a point is, of a square with a side of 2^kCurveBits: the quarter that it is
/// in gives two bits, and within the quarter the curve is turned so that its ends meet those of the next.
std::uint64_t AlongCurve(std::uint32_t x, std::uint32_t y) {
  std::uint64_t along = 0;
  for (int bit = kCurveBits - 1; bit >= 0; --bit) {
    const std::uint32_t right = x >> bit & 1;
    const std::uint32_t upper = y >> bit & 1;
    along = along << 2 | ((3 * right) ^ upper);
    // Without branches, which nobody could foretell: all bits of both turned, and both swapped.
    const std::uint32_t turn = 0 - (right & ~upper);
    const std::uint32_t swap = ((x ^ y) & (0 - (upper ^ 1)));
    x ^= turn ^ swap;
    y ^= turn ^ swap;
  }
  return along;
}

/// How many by eight, the last ones incomplete.
std::size_t Eighths(std::size_t count) { return (count + kLanes - 1) / kLanes; }

}  // namespace

void ProximityIndex::Load(const std::vector<Traffic>& fleet, const ProximityRules& rules) {
  fleet_ = &fleet;
  rules_ = &rules;
  formation_ids_.clear();
  limits_.assign(1, &rules.strangers);
  for (const auto& [id, limits] : rules.formations) {
    formation_ids_.push_back(id);
    limits_.push_back(&limits);
  }
  leaves_.resize(Eighths(fleet.size()));
  boxes_.resize(leaves_.size());
  if (fleet.empty()) return;
  SortAlongCurve();
  ForAllLeaves([this](std::size_t from, std::size_t to) {
    for (std::size_t leaf = from; leaf < to; ++leaf) FillLeaf(leaf);
  });
  FillLevels();
}

void ProximityIndex::SortAlongCurve() {
  Eigen::Vector2d low = fleet_->front().position.head<2>();
  Eigen::Vector2d high = low;
  for (const Traffic& uav : *fleet_) {
    low = low.cwiseMin(uav.position.head<2>());
    high = high.cwiseMax(uav.position.head<2>());
  }
  const double extent_m = (high - low).maxCoeff();
  const double per_m = extent_m > 0 ? ((1 << kCurveBits) - 1) / extent_m : 0;
  along_curve_.clear();
  for (std::uint64_t place = 0; place < fleet_->size(); ++place) {
    const Eigen::Vector2d steps = ((*fleet_)[place].position.head<2>() - low) * per_m;
    const std::uint64_t along =
        AlongCurve(static_cast<std::uint32_t>(steps.x()), static_cast<std::uint32_t>(steps.y()));
    along_curve_.push_back(along << kPlaceBits | place);
  }
  boost::sort::spreadsort::integer_sort(along_curve_.begin(), along_curve_.end());
}

int ProximityIndex::PlaceOf(std::size_t leaf, std::size_t lane) const {
  return static_cast<int>(along_curve_[leaf * kLanes + lane] & kPlaceMask);
}

double ProximityIndex::GroupOf(int formation_id) const {
  if (formation_id == 0) return 0;
  const auto found = std::lower_bound(formation_ids_.begin(), formation_ids_.end(), formation_id);
  if (found == formation_ids_.end() || *found != formation_id) return 0;
  return 1 + static_cast<double>(found - formation_ids_.begin());
}

void ProximityIndex::Box::Include(const Box& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
    velocity_low[axis] = std::min(velocity_low[axis], other.velocity_low[axis]);
    velocity_high[axis] = std::max(velocity_high[axis], other.velocity_high[axis]);
  }
  if (group != other.group) group = kSeveralGroups;
}

void ProximityIndex::FillLeaf(std::size_t leaf) {
  EightUavs& uavs = leaves_[leaf];
  const std::size_t in_use = InUse(leaf, fleet_->size());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (lane >= in_use) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        uavs.position[axis][lane] = kNotInUse;
        uavs.velocity[axis][lane] = 0;
      }
      uavs.group[lane] = 0;
      continue;
    }
    const Traffic& uav = (*fleet_)[PlaceOf(leaf, lane)];
    Box one;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<int>(axis);
      uavs.position[axis][lane] = one.low[axis] = one.high[axis] = uav.position[row];
      uavs.velocity[axis][lane] = one.velocity_low[axis] = one.velocity_high[axis] = uav.velocity[row];
    }
    uavs.group[lane] = one.group = GroupOf(uav.formation_id);
    if (lane == 0) {
      boxes_[leaf] = one;
    } else {
      boxes_[leaf].Include(one);
    }
  }
}

void ProximityIndex::FillLevels() {
  std::size_t count = leaves_.size();
  std::size_t level = 0;
  do {
    if (levels_.size() == level) levels_.emplace_back();
    levels_[level].resize(Eighths(count));
    for (std::size_t i = 0; i < count; ++i) {
      const Box box = boxes_[i];
      EightBoxes& eight = levels_[level][i / kLanes];
      const std::size_t lane = i % kLanes;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        eight.low[axis][lane] = box.low[axis];
        eight.high[axis][lane] = box.high[axis];
        eight.velocity_low[axis][lane] = box.velocity_low[axis];
        eight.velocity_high[axis][lane] = box.velocity_high[axis];
      }
      eight.group[lane] = box.group;
      // The box above takes a place whose own has been packed already.
      if (lane == 0) {
        boxes_[i / kLanes] = box;
      } else {
        boxes_[i / kLanes].Include(box);
      }
    }
    count = levels_[level++].size();
  } while (count > 1);
  levels_.resize(level);
}

const ProximityLimits& ProximityIndex::LimitsBetween(double group, double other_group) const {
  return *limits_[group == other_group ? static_cast<std::size_t>(group) : 0];
}

void ProximityIndex::ForAllLeaves(const std::function<void(std::size_t from, std::size_t to)>& work) const {
  const std::size_t parts =
      fleet_->size() < kParallelFrom ? 1 : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (std::size_t part = 1; part < parts; ++part) {
    helpers.emplace_back(work, leaves_.size() * part / parts, leaves_.size() * (part + 1) / parts);
  }
  work(0, leaves_.size() / parts);
}

}  // namespace skein

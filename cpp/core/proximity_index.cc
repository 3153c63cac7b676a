#include "core/proximity_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>

namespace skein {
namespace {

constexpr double kNobody = std::numeric_limits<double>::infinity();
constexpr double kSeveralGroups = -1;
/// Fleets from this size on are searched by all processors: below it, a thread costs more than it takes over.
constexpr std::size_t kParallelFrom = 4096;
/// Steps along each axis of the curve.
constexpr double kCurveSteps = (1 << 22) - 1;

/// Every bit moved to twice its place.
std::uint64_t Spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

TauLimits Of(const ProximityLimits& limits) { return {limits.d_mod_m, limits.min_closing_m_s}; }

/// A box, or a leaf, that is still to be looked into.
struct ToVisit {
  std::size_t level;  ///< 0: a leaf
  std::size_t index;
  double range_m;
  double tau_s;
};

}  // namespace

struct ProximityIndex::Box {
  std::array<double, 3> low, high, velocity_low, velocity_high;
  double group;

  void Include(const Box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
      velocity_low[axis] = std::min(velocity_low[axis], other.velocity_low[axis]);
      velocity_high[axis] = std::max(velocity_high[axis], other.velocity_high[axis]);
    }
    if (group != other.group) group = kSeveralGroups;
  }
};

struct ProximityIndex::Best {
  std::pair<double, int> nearest{kNobody, 0};
  int nearest_place = -1;
  std::pair<double, int> least_tau{kNobody, 0};

  /// Whether what is no nearer and has no less Tau than this may be better still, or as good with a smaller
  /// id.
  bool MayGain(double range_m, double tau_s) const {
    return range_m <= nearest.first || (tau_s < kNobody && tau_s <= least_tau.first);
  }
};

ProximityIndex::ProximityIndex(const std::vector<Traffic>& fleet, const ProximityRules& rules)
    : fleet_(fleet), rules_(rules), strangers_(Of(rules.strangers)) {
  if (fleet.empty()) return;
  Sort();
  Build();
}

void ProximityIndex::Sort() {
  Eigen::Vector2d low = fleet_.front().position.head<2>();
  Eigen::Vector2d high = low;
  for (const Traffic& uav : fleet_) {
    low = low.cwiseMin(uav.position.head<2>());
    high = high.cwiseMax(uav.position.head<2>());
  }
  const double extent_m = (high - low).maxCoeff();
  const double per_m = extent_m > 0 ? kCurveSteps / extent_m : 0;
  std::vector<std::pair<std::uint64_t, int>> along_curve;
  along_curve.reserve(fleet_.size());
  for (int place = 0; place < static_cast<int>(fleet_.size()); ++place) {
    const Eigen::Vector2d steps = (fleet_[place].position.head<2>() - low) * per_m;
    along_curve.emplace_back(
        Spread(static_cast<std::uint64_t>(steps.x())) | Spread(static_cast<std::uint64_t>(steps.y())) << 1,
        place);
  }
  std::sort(along_curve.begin(), along_curve.end());
  places_.reserve(fleet_.size());
  for (const auto& [step, place] : along_curve) places_.push_back(place);
}

double ProximityIndex::GroupOf(int formation_id) {
  // Members of one formation mostly come one after the other.
  if (formation_id == last_group_.first) return last_group_.second;
  const auto found = rules_.formations.find(formation_id);
  const bool has_own = formation_id != 0 && found != rules_.formations.end();
  last_group_ = {formation_id,
                 has_own ? 1 + static_cast<double>(std::distance(rules_.formations.begin(), found)) : 0};
  return last_group_.second;
}

void ProximityIndex::Build() {
  for (const auto& [id, limits] : rules_.formations) groups_.push_back(Of(limits));

  std::vector<Box> boxes;
  leaves_.resize((fleet_.size() + kLanes - 1) / kLanes);
  boxes.reserve(leaves_.size());
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    EightUavs& uavs = leaves_[leaf];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // Lanes that are not in use hold the last one again.
      const Traffic& uav = fleet_[places_[std::min(leaf * kLanes + lane, fleet_.size() - 1)]];
      Box one;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        uavs.position[axis][lane] = one.low[axis] = one.high[axis] = uav.position[static_cast<int>(axis)];
        uavs.velocity[axis][lane] = one.velocity_low[axis] = one.velocity_high[axis] =
            uav.velocity[static_cast<int>(axis)];
      }
      uavs.group[lane] = one.group = GroupOf(uav.formation_id);
      if (lane == 0) {
        boxes.push_back(one);
      } else {
        boxes.back().Include(one);
      }
    }
  }
  while (boxes.size() > 1) {
    std::vector<Box> larger;
    std::vector<EightBoxes>& level = levels_.emplace_back((boxes.size() + kLanes - 1) / kLanes);
    for (std::size_t i = 0; i < level.size() * kLanes; ++i) {
      const Box& box = boxes[std::min(i, boxes.size() - 1)];
      EightBoxes& eight = level[i / kLanes];
      const std::size_t lane = i % kLanes;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        eight.low[axis][lane] = box.low[axis];
        eight.high[axis][lane] = box.high[axis];
        eight.velocity_low[axis][lane] = box.velocity_low[axis];
        eight.velocity_high[axis][lane] = box.velocity_high[axis];
      }
      eight.group[lane] = box.group;
      if (lane == 0) {
        larger.push_back(box);
      } else {
        larger.back().Include(box);
      }
    }
    boxes = std::move(larger);
  }
}

std::size_t ProximityIndex::InUse(std::size_t index, std::size_t total) {
  return std::min(kLanes, total - index * kLanes);
}

Looker ProximityIndex::LookerOf(std::size_t leaf, std::size_t lane) const {
  const EightUavs& uavs = leaves_[leaf];
  Looker looker;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    looker.position[axis] = uavs.position[axis][lane];
    looker.velocity[axis] = uavs.velocity[axis][lane];
  }
  looker.group = uavs.group[lane];
  looker.others = strangers_;
  looker.own = looker.group > 0 ? groups_[static_cast<std::size_t>(looker.group) - 1] : strangers_;
  looker.widest = {std::max(looker.own.d_mod_m, looker.others.d_mod_m),
                   std::max(looker.own.min_closing_m_s, looker.others.min_closing_m_s)};
  return looker;
}

void ProximityIndex::LookAtLeaf(std::size_t leaf, const Looker& looker, int self, Best& best) const {
  Looks looks;
  LookAt(leaves_[leaf], looker, looks);
  for (std::size_t lane = 0; lane < InUse(leaf, fleet_.size()); ++lane) {
    if (!best.MayGain(looks.range_m[lane], looks.tau_s[lane])) continue;
    const int place = places_[leaf * kLanes + lane];
    if (place == self) continue;
    const int id = fleet_[place].id;
    if (const std::pair candidate{looks.range_m[lane], id}; candidate < best.nearest) {
      best.nearest = candidate;
      best.nearest_place = place;
    }
    if (looks.tau_s[lane] < kNobody)
      best.least_tau = std::min(best.least_tau, std::pair{looks.tau_s[lane], id});
  }
}

VehicleProximity ProximityIndex::FindOne(std::size_t leaf, std::size_t lane) const {
  const int self = places_[leaf * kLanes + lane];
  const Looker looker = LookerOf(leaf, lane);
  Best best;
  // Its neighbours first: what they give leaves out most of the rest.
  LookAtLeaf(leaf, looker, self, best);

  // The nearest is on top. Seven of eight boxes at most wait on each level while the eighth is looked into.
  std::array<ToVisit, kLanes * 22> waiting;
  std::size_t count = 0;
  if (!levels_.empty()) waiting[count++] = {levels_.size(), 0, 0, 0};
  while (count > 0) {
    const ToVisit next = waiting[--count];
    if (!best.MayGain(next.range_m, next.tau_s)) continue;
    if (next.level == 0) {
      if (next.index != leaf) LookAtLeaf(next.index, looker, self, best);
      continue;
    }
    const std::vector<EightBoxes>& level = levels_[next.level - 1];
    const std::size_t below = next.level == 1 ? leaves_.size() : levels_[next.level - 2].size();
    Looks looks;
    LookAt(level[next.index], looker, looks);
    const std::size_t first = count;
    for (std::size_t child = 0; child < InUse(next.index, below); ++child) {
      const ToVisit one{next.level - 1, next.index * kLanes + child, looks.range_m[child],
                        looks.tau_s[child]};
      if (!best.MayGain(one.range_m, one.tau_s)) continue;
      std::size_t at = count++;
      for (; at > first && waiting[at - 1].range_m < one.range_m; --at) waiting[at] = waiting[at - 1];
      waiting[at] = one;
    }
  }

  VehicleProximity found;
  found.id = fleet_[self].id;
  if (best.nearest_place >= 0) {
    found.nearest =
        NearestUav{best.nearest.second, Separate(fleet_[self].position, fleet_[best.nearest_place].position)};
  }
  if (best.least_tau.second != 0) found.least_tau = LeastTau{best.least_tau.second, best.least_tau.first};
  return found;
}

std::vector<VehicleProximity> ProximityIndex::Find() const {
  std::vector<VehicleProximity> result(fleet_.size());
  const auto find = [&](std::size_t from_leaf, std::size_t to_leaf) {
    for (std::size_t leaf = from_leaf; leaf < to_leaf; ++leaf) {
      for (std::size_t lane = 0; lane < InUse(leaf, fleet_.size()); ++lane) {
        result[places_[leaf * kLanes + lane]] = FindOne(leaf, lane);
      }
    }
  };
  const std::size_t parts =
      fleet_.size() < kParallelFrom ? 1 : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (std::size_t part = 1; part < parts; ++part) {
    helpers.emplace_back(find, leaves_.size() * part / parts, leaves_.size() * (part + 1) / parts);
  }
  find(0, leaves_.size() / parts);
  helpers.clear();  // waits for them
  return result;
}

std::vector<VehicleProximity> FindProximityByIndex(const std::vector<Traffic>& fleet,
                                                   const ProximityRules& rules) {
  return ProximityIndex(fleet, rules).Find();
}

}  // namespace skein

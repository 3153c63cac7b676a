// What a ProximityIndex is for: searching it.
#include <algorithm>
#include <array>
#include <limits>
#include <mutex>

#include "core/proximity_index.h"

namespace skein {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double Square(double value) { return value * value; }

/// The best that one UAV has found so far.
struct Best {
  std::pair<double, int> nearest{kInfinite, 0};
  int nearest_place = -1;
  std::pair<double, int> least_tau{kInfinite, 0};
};

VehicleProximity Told(const Best& best, const std::vector<Traffic>& fleet, int place) {
  VehicleProximity found;
  found.id = fleet[place].id;
  if (best.nearest_place >= 0) {
    found.nearest =
        NearestUav{best.nearest.second, Separate(fleet[place].position, fleet[best.nearest_place].position)};
  }
  if (best.least_tau.second != 0) found.least_tau = LeastTau{best.least_tau.second, best.least_tau.first};
  return found;
}

}  // namespace

/// The search of one leaf. Calls look(lane, leaf, lane of leaf) for whoever may matter, which may narrow the
/// reach of the lookers.
template <typename Look>
class ProximityIndex::Search {
 public:
  Search(const ProximityIndex& index, std::size_t home, const EightLookers& lookers, const Look& look)
      : index_(index), home_(home), lookers_(lookers), look_(look) {}

  void Run() {
    // Neighbours first: what they give leaves out most of the rest.
    Marks all;
    all.fill(1);
    LookInto(home_, all);
    Visit(index_.levels_.size() - 1, 0);
  }

 private:
  void LookInto(std::size_t leaf, const Marks& lookers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Marks who;
      if (!lookers[lane] || !MayMatter(lookers_, lane, index_.leaves_[leaf], who)) continue;
      for (std::size_t other = 0; other < kLanes; ++other) {
        if (who[other] && !(leaf == home_ && lane == other)) look_(lane, leaf, other);
      }
    }
  }

  void Visit(std::size_t level, std::size_t index) {
    const EightBoxes& boxes = index_.levels_[level][index];
    Lanes gap_m2;
    Gaps(index_.levels_[0][home_ / kLanes], home_ % kLanes, boxes, gap_m2);
    const std::size_t count =
        InUse(index, level == 0 ? index_.leaves_.size() : index_.levels_[level - 1].size());
    std::array<std::size_t, kLanes> order;
    for (std::size_t box = 0; box < count; ++box) {
      std::size_t at = box;
      for (; at > 0 && gap_m2[box] < gap_m2[order[at - 1]]; --at) order[at] = order[at - 1];
      order[at] = box;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t below = index * kLanes + order[i];
      if (level == 0 && below == home_) continue;
      Marks to;
      if (!MayMatter(lookers_, boxes, order[i], to)) continue;
      if (level == 0) {
        LookInto(below, to);
      } else {
        Visit(level - 1, below);
      }
    }
  }

  const ProximityIndex& index_;
  const std::size_t home_;
  const EightLookers& lookers_;
  const Look& look_;
};

template <typename ReachOf>
EightLookers ProximityIndex::LookersOf(std::size_t leaf, const ReachOf& reach_of) const {
  EightLookers lookers;
  lookers.uavs = &leaves_[leaf];
  const PairReach others = reach_of(*limits_[0]);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double group = leaves_[leaf].group[lane];
    lookers.own.Set(lane, group > 0 ? reach_of(LimitsBetween(group, group)) : others);
    lookers.others.Set(lane, others);
  }
  return lookers;
}

const std::vector<VehicleProximity>& ProximityIndex::FindProximity() {
  found_.resize(fleet_->size());
  const auto anybody = [](const ProximityLimits& limits) {
    return PairReach{kInfinite, kInfinite, Square(limits.d_mod_m), Square(limits.min_closing_m_s)};
  };
  ForAllLeaves([&](std::size_t from, std::size_t to) {
    for (std::size_t leaf = from; leaf < to; ++leaf) {
      EightLookers lookers = LookersOf(leaf, anybody);
      std::array<Best, kLanes> bests;
      const auto look = [&](std::size_t lane, std::size_t other_leaf, std::size_t other_lane) {
        const int other_place = PlaceOf(other_leaf, other_lane);
        const Traffic& other = (*fleet_)[other_place];
        const PairMotion motion = MotionBetween((*fleet_)[PlaceOf(leaf, lane)], other);
        Best& best = bests[lane];
        if (const std::pair candidate{motion.range_m, other.id}; candidate < best.nearest) {
          best.nearest = candidate;
          best.nearest_place = other_place;
          lookers.own.range_m2[lane] = lookers.others.range_m2[lane] = Square(motion.range_m);
        }
        const ProximityLimits& limits =
            LimitsBetween(leaves_[leaf].group[lane], leaves_[other_leaf].group[other_lane]);
        const std::optional<double> tau_s = Tau(motion, limits.d_mod_m, limits.min_closing_m_s);
        if (tau_s && std::pair{*tau_s, other.id} < best.least_tau) {
          best.least_tau = {*tau_s, other.id};
          lookers.own.tau_s[lane] = lookers.others.tau_s[lane] = *tau_s;
        }
      };
      Search(*this, leaf, lookers, look).Run();
      for (std::size_t lane = 0; lane < InUse(leaf, fleet_->size()); ++lane) {
        const int place = PlaceOf(leaf, lane);
        found_[place] = Told(bests[lane], *fleet_, place);
      }
    }
  });
  return found_;
}

std::vector<std::pair<int, int>> ProximityIndex::FindPairs(
    const std::function<bool(int first, int second)>& holds) const {
  double horizontal_m = 0;
  double vertical_m = 0;
  for (const Traffic& uav : *fleet_) {
    horizontal_m = std::max(horizontal_m, uav.horizontal_uncertainty_m);
    vertical_m = std::max(vertical_m, uav.vertical_uncertainty_m);
  }
  // As wide as the most uncertain pair makes it, and round: a ball about the cylinder.
  const auto levels = [&](const ProximityLimits& limits) {
    return PairReach{Square(limits.radius_m + 2 * horizontal_m) + Square(limits.height_m + 2 * vertical_m),
                     limits.advisory_tau_s, Square(limits.d_mod_m + 2 * horizontal_m),
                     Square(limits.min_closing_m_s)};
  };
  std::vector<std::pair<int, int>> result;
  std::mutex result_mutex;
  ForAllLeaves([&](std::size_t from, std::size_t to) {
    std::vector<std::pair<int, int>> found;
    for (std::size_t leaf = from; leaf < to; ++leaf) {
      const EightLookers lookers = LookersOf(leaf, levels);
      const auto look = [&](std::size_t lane, std::size_t other_leaf, std::size_t other_lane) {
        const int first = PlaceOf(leaf, lane);
        const int second = PlaceOf(other_leaf, other_lane);
        if (first < second && holds(first, second)) found.emplace_back(first, second);
      };
      Search(*this, leaf, lookers, look).Run();
    }
    const std::scoped_lock lock(result_mutex);
    result.insert(result.end(), found.begin(), found.end());
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace skein

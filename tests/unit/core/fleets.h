#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/proximity.h"

namespace skein::testing {

/// Sets of thresholds that differ in every field, formation 3 on purpose missing.
inline ProximityRules MixedRules() {
  ProximityRules rules;
  rules.formations[1] = ProximityLimits{};
  ProximityLimits loose;
  loose.radius_m = 300;
  loose.height_m = 80;
  loose.d_mod_m = 700;
  loose.advisory_tau_s = 70;
  loose.caution_tau_s = 20;
  loose.min_closing_m_s = 5;
  rules.formations[2] = loose;
  return rules;
}

inline Traffic RandomUav(int id, const Eigen::Vector3d& middle, double reach_m, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_real_distribution<double> speed(-60, 60);
  Traffic uav;
  uav.id = id;
  uav.position = middle + reach_m * Eigen::Vector3d(place(random), place(random), 0.05 * place(random));
  uav.velocity = {speed(random), speed(random), 0.1 * speed(random)};
  uav.formation_id = std::uniform_int_distribution<int>(0, 3)(random);
  if (random() % 8 == 0) {
    uav.horizontal_uncertainty_m = std::abs(300 * place(random));
    uav.vertical_uncertainty_m = std::abs(50 * place(random));
  }
  return uav;
}

/// Spread evenly over a square.
inline std::vector<Traffic> SpreadFleet(int count, std::mt19937& random) {
  std::vector<Traffic> fleet;
  for (int i = 0; i < count; ++i) fleet.push_back(RandomUav(1 + i, {0, 0, 1000}, 10000, random));
  std::shuffle(fleet.begin(), fleet.end(), random);
  return fleet;
}

/// In tight groups far from one another, each flying as one, and a few stragglers.
inline std::vector<Traffic> ClusteredFleet(int count, std::mt19937& random) {
  std::vector<Traffic> fleet;
  Traffic group;
  for (int i = 0; i < count; ++i) {
    if (i % 20 == 0) group = RandomUav(1, {0, 0, 1000}, 30000, random);
    Traffic uav = RandomUav(1 + i, group.position, 400, random);
    if (i % 20 != 7) uav.velocity = group.velocity + 0.01 * uav.velocity;
    uav.formation_id = group.formation_id;
    fleet.push_back(uav);
  }
  std::shuffle(fleet.begin(), fleet.end(), random);
  return fleet;
}

/// On the points of a coarse grid with few different velocities: full of equal distances, equal Taus, shared
/// points.
inline std::vector<Traffic> TiedFleet(int count, std::mt19937& random) {
  std::uniform_int_distribution<int> cell(0, 9);
  std::uniform_int_distribution<int> step(-1, 1);
  std::vector<Traffic> fleet;
  for (int i = 0; i < count; ++i) {
    Traffic uav;
    uav.id = 1 + i;
    uav.position = {1000.0 * cell(random), 1000.0 * cell(random), 100.0 * step(random)};
    uav.velocity = {50.0 * step(random), 50.0 * step(random), 0};
    fleet.push_back(uav);
  }
  std::shuffle(fleet.begin(), fleet.end(), random);
  return fleet;
}

}  // namespace skein::testing

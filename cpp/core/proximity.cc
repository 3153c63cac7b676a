#include "core/proximity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/proximity_index.h"

namespace skein {
namespace {

void Require(bool good, const char* field, const char* reason) {
  if (!good) throw std::invalid_argument(std::string(field) + ": " + reason);
}

}  // namespace

ProximityLimits StrangerLimits() {
  ProximityLimits limits;
  limits.radius_m = 500;
  limits.height_m = 100;
  limits.d_mod_m = 500;
  limits.advisory_tau_s = 55;
  limits.caution_tau_s = 25;
  return limits;
}

void Check(const ProximityLimits& limits) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  Require(positive(limits.radius_m), "radius_m", "must be above 0");
  Require(positive(limits.height_m), "height_m", "must be above 0");
  Require(std::isfinite(limits.d_mod_m) && limits.d_mod_m >= limits.radius_m, "d_mod_m",
          "must be at least radius_m, or the levels come in the wrong order");
  Require(positive(limits.caution_tau_s), "caution_tau_s", "must be above 0");
  Require(std::isfinite(limits.advisory_tau_s) && limits.advisory_tau_s > limits.caution_tau_s,
          "advisory_tau_s", "must be above caution_tau_s");
  Require(positive(limits.min_closing_m_s), "min_closing_m_s", "must be above 0");
}

const ProximityLimits& ProximityRules::Between(const Traffic& one, const Traffic& other) const {
  if (one.formation_id == 0 || one.formation_id != other.formation_id) return strangers;
  const auto found = formations.find(one.formation_id);
  return found == formations.end() ? strangers : found->second;
}

ProximityLimits ProximityRules::Widest() const {
  ProximityLimits widest = strangers;
  for (const auto& [id, limits] : formations) {
    widest.radius_m = std::max(widest.radius_m, limits.radius_m);
    widest.height_m = std::max(widest.height_m, limits.height_m);
    widest.d_mod_m = std::max(widest.d_mod_m, limits.d_mod_m);
    widest.advisory_tau_s = std::max(widest.advisory_tau_s, limits.advisory_tau_s);
    widest.caution_tau_s = std::max(widest.caution_tau_s, limits.caution_tau_s);
    widest.min_closing_m_s = std::max(widest.min_closing_m_s, limits.min_closing_m_s);
  }
  return widest;
}

Separation Separate(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  const double x = other.x() - one.x();
  const double y = other.y() - one.y();
  return {std::sqrt(x * x + y * y), std::abs(other.z() - one.z())};
}

PairMotion MotionBetween(const Traffic& one, const Traffic& other) {
  // Written out, in this order: what a search leaves out, it leaves out by bounds that add up
  // in the same order (proximity_lanes.cc).
  const Eigen::Vector3d r = other.position - one.position;
  const Eigen::Vector3d w = other.velocity - one.velocity;
  const double range_m = std::sqrt(r.x() * r.x() + r.y() * r.y() + r.z() * r.z());
  if (range_m == 0) return {};
  return {range_m, -(r.x() * w.x() + r.y() * w.y() + r.z() * w.z()) / range_m};
}

std::optional<double> Tau(const PairMotion& motion, double d_mod_m, double min_closing_m_s) {
  if (motion.range_m == 0) return 0;
  if (motion.closing_m_s <= 0) return std::nullopt;
  if (motion.range_m <= d_mod_m) return 0;
  return (motion.range_m - d_mod_m * d_mod_m / motion.range_m) /
         std::max(motion.closing_m_s, min_closing_m_s);
}

bool NearestUav::operator==(const NearestUav& other) const {
  return id == other.id && separation.horizontal_m == other.separation.horizontal_m &&
         separation.vertical_m == other.separation.vertical_m;
}

std::vector<VehicleProximity> FindProximityByBruteForce(const std::vector<Traffic>& fleet,
                                                        const ProximityRules& rules) {
  std::vector<VehicleProximity> result;
  for (const Traffic& self : fleet) {
    VehicleProximity& found = result.emplace_back();
    found.id = self.id;
    double nearest_m = 0;
    for (const Traffic& other : fleet) {
      if (&other == &self) continue;
      const PairMotion motion = MotionBetween(self, other);
      if (!found.nearest || std::pair(motion.range_m, other.id) < std::pair(nearest_m, found.nearest->id)) {
        nearest_m = motion.range_m;
        found.nearest = NearestUav{other.id, Separate(self.position, other.position)};
      }
      const ProximityLimits& limits = rules.Between(self, other);
      const std::optional<double> tau_s = Tau(motion, limits.d_mod_m, limits.min_closing_m_s);
      if (tau_s && (!found.least_tau ||
                    std::pair(*tau_s, other.id) < std::pair(found.least_tau->tau_s, found.least_tau->id))) {
        found.least_tau = LeastTau{other.id, *tau_s};
      }
    }
  }
  return result;
}

std::vector<VehicleProximity> FindProximity(const std::vector<Traffic>& fleet, const ProximityRules& rules) {
  ProximityIndex index;
  index.Load(fleet, rules);
  return index.FindProximity();
}

}  // namespace skein

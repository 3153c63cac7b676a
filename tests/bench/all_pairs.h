#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/proximity.h"

namespace skein::bench {

/// What a search for nearest UAVs and least Tau is measured against: everybody with everybody, several pairs
/// in one instruction, without ids and with one set of thresholds. That is less than a search has to do.
class AllPairs {
 public:
  AllPairs(const std::vector<Traffic>& fleet, const ProximityLimits& limits);

  /// Of all least distances and Taus, so that they have to be worked out.
  double Sum() const;

 private:
  struct Least {
    double square_m2;
    double tau_s;
  };
  void Look(std::size_t self, std::size_t from, std::size_t to, Least& least) const;

  ProximityLimits limits_;
  std::array<std::vector<double>, 3> position_;
  std::array<std::vector<double>, 3> velocity_;
};

}  // namespace skein::bench

#pragma once

#include <cmath>
#include <vector>

namespace skein::experiment {

/// Of sorted numbers, at least one; between two of them on the straight line (R's type 7).
/// @param share 0 .. 1
inline double Quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double fraction = place - std::floor(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + fraction * (sorted[below + 1] - sorted[below]);
}

}  // namespace skein::experiment

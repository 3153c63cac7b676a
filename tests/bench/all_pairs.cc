#include "bench/all_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/processors.h"

namespace skein::bench {
namespace {

// Not infinite: this file is compiled for a mathematics without infinities, which is the faster one.
constexpr double kNobody = 1e18;

}  // namespace

AllPairs::AllPairs(const std::vector<Traffic>& fleet, const ProximityLimits& limits) : limits_(limits) {
  for (const Traffic& uav : fleet) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position_[axis].push_back(uav.position[static_cast<int>(axis)]);
      velocity_[axis].push_back(uav.velocity[static_cast<int>(axis)]);
    }
  }
}

double AllPairs::Sum() const {
  double sum = 0;
  const std::size_t count = position_[0].size();
  for (std::size_t i = 0; i < count; ++i) {
    Least least{kNobody, kNobody};
    Look(i, 0, i, least);
    Look(i, i + 1, count, least);
    sum += least.square_m2 + std::min(least.tau_s, 1e6);
  }
  return sum;
}

SKEIN_FOR_EACH_PROCESSOR
void AllPairs::Look(std::size_t self, std::size_t from, std::size_t to, Least& least) const {
  const double* x = position_[0].data();
  const double* y = position_[1].data();
  const double* z = position_[2].data();
  const double* u = velocity_[0].data();
  const double* v = velocity_[1].data();
  const double* w = velocity_[2].data();
  const double d_mod_m = limits_.d_mod_m;
  const double min_closing_m_s = limits_.min_closing_m_s;
  const double self_x = x[self], self_y = y[self], self_z = z[self];
  const double self_u = u[self], self_v = v[self], self_w = w[self];
  double nearest = least.square_m2;
  double tau = least.tau_s;
  for (std::size_t i = from; i < to; ++i) {
    const double rx = x[i] - self_x;
    const double ry = y[i] - self_y;
    const double rz = z[i] - self_z;
    const double square = rx * rx + ry * ry + rz * rz;
    const double range = std::sqrt(square);
    const double closing = -(rx * (u[i] - self_u) + ry * (v[i] - self_v) + rz * (w[i] - self_w)) / range;
    const double outside = std::max(range - d_mod_m * d_mod_m / range, 0.0);
    const double candidate = closing > 0 ? outside / std::max(closing, min_closing_m_s) : kNobody;
    nearest = std::min(nearest, square);
    tau = std::min(tau, candidate);
  }
  least.square_m2 = nearest;
  least.tau_s = tau;
}

}  // namespace skein::bench

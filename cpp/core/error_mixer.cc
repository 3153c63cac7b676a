#include "core/error_mixer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/frames.h"

namespace skein {
namespace {

void CheckNotNegative(double value, const char* name) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " must not be negative");
  }
}

void CheckPositive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " must be above 0");
  }
}

double Saturate(double value, double limit) { return std::clamp(value, -limit, limit); }

}  // namespace

StateError ErrorInLeaderFrame(const VehicleState& leader, const SlotOffset& slot, const VehicleState& uav) {
  const Eigen::Vector2d from_leader(uav.east_m - leader.east_m, uav.north_m - leader.north_m);
  const Eigen::Vector2d actual = ToLeaderFrame(from_leader, leader.course_rad);
  return {slot.forward_m - actual.x(),
          slot.left_m - actual.y(),
          leader.up_m + slot.up_m - uav.up_m,
          leader.speed_m_s - uav.speed_m_s,
          WrapAngle(leader.course_rad - uav.course_rad),
          leader.climb_rad - uav.climb_rad};
}

void Check(const MixerGains& gains) {
  CheckNotNegative(gains.k_ex, "k_ex");
  CheckNotNegative(gains.k_ev, "k_ev");
  CheckNotNegative(gains.k_ey, "k_ey");
  CheckNotNegative(gains.k_ephi, "k_ephi");
  CheckNotNegative(gains.k_ez, "k_ez");
  CheckNotNegative(gains.k_emu, "k_emu");
  CheckPositive(gains.saturation_forward_m, "saturation_forward_m");
  CheckPositive(gains.saturation_left_m, "saturation_left_m");
  CheckPositive(gains.saturation_up_m, "saturation_up_m");
}

MixedError Mix(const StateError& error, const MixerGains& gains) {
  return {gains.k_ex * Saturate(error.forward_m, gains.saturation_forward_m) + gains.k_ev * error.speed_m_s,
          gains.k_ey * Saturate(error.left_m, gains.saturation_left_m) + gains.k_ephi * error.course_rad,
          gains.k_ez * Saturate(error.up_m, gains.saturation_up_m) + gains.k_emu * error.climb_rad};
}

}  // namespace skein

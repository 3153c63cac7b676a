#include "core/dead_reckoning.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace skein {
namespace {

constexpr double kClimbsOn = 1;  // [s] after which a UAV without commands flies level

}  // namespace

void Check(const UncertaintyGrowth& growth) {
  const auto require = [](double value, const char* field) {
    if (!std::isfinite(value) || value < 0)
      throw std::invalid_argument(std::string(field) + ": must be at least 0");
  };
  require(growth.horizontal_m_s, "horizontal_m_s");
  require(growth.vertical_m_s, "vertical_m_s");
  require(growth.most_horizontal_m, "most_horizontal_m");
  require(growth.most_vertical_m, "most_vertical_m");
}

Estimate DeadReckon(const VehicleState& state, double age_s, double silent_s,
                    const UncertaintyGrowth& growth) {
  const double horizontal_m_s = state.speed_m_s * std::cos(state.climb_rad);
  Estimate estimate;
  estimate.velocity = {horizontal_m_s * std::cos(state.course_rad),
                       horizontal_m_s * std::sin(state.course_rad),
                       state.speed_m_s * std::sin(state.climb_rad)};
  estimate.position = Eigen::Vector3d(state.east_m, state.north_m, state.up_m);
  estimate.position.head<2>() += estimate.velocity.head<2>() * age_s;
  estimate.position.z() += estimate.velocity.z() * std::min(age_s, kClimbsOn);
  if (age_s > kClimbsOn) estimate.velocity.z() = 0;
  estimate.horizontal_uncertainty_m = std::min(growth.horizontal_m_s * silent_s, growth.most_horizontal_m);
  estimate.vertical_uncertainty_m = std::min(growth.vertical_m_s * silent_s, growth.most_vertical_m);
  return estimate;
}

}  // namespace skein

#include "controller/altitude_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skein::controller {
namespace {

// The paper's climb first, then less of it, then the same downwards.
constexpr std::array kSteps = {200.0, 160.0, 120.0, -200.0, -160.0, -120.0};
constexpr double kLookAhead = 60;  // [s]; a climb of 200 m takes 25 s

/// Least horizontal distance within the look-ahead, both flying straight on.
double PredictedMiss(const Traffic& a, const Traffic& b) {
  const Eigen::Vector2d apart = (b.position - a.position).head<2>();
  const Eigen::Vector2d closing = (b.velocity - a.velocity).head<2>();
  const double squared = closing.squaredNorm();
  const double when = squared > 0 ? std::clamp(-apart.dot(closing) / squared, 0.0, kLookAhead) : 0.0;
  return (apart + when * closing).norm();
}

}  // namespace

bool FreeOfTraffic(double now_m, double offset_m, const std::vector<Traffic>& body,
                   const std::vector<Traffic>& strangers, const ProximityLimits& limits) {
  for (const Traffic& own : body) {
    const double from = own.position.z() + std::min(0.0, offset_m - now_m) - limits.height_m;
    const double to = own.position.z() + std::max(0.0, offset_m - now_m) + limits.height_m;
    for (const Traffic& other : strangers) {
      // Somebody who is in the way already, at this very altitude, is no reason against leaving it.
      const bool between = other.position.z() > from && other.position.z() < to;
      const bool here = std::abs(other.position.z() - own.position.z()) < limits.height_m;
      if (between && !here && PredictedMiss(own, other) < 1.2 * limits.radius_m) return false;
    }
  }
  return true;
}

std::optional<double> ChooseOffset(double now_m, double target_m,
                                   const std::vector<SeparatedMember>& separated,
                                   const std::vector<Traffic>& body, const std::vector<Traffic>& strangers,
                                   const AirspaceLimits& limits) {
  const auto clear = [&](double offset, double clearance) {
    return offset <= limits.highest_m && offset >= limits.lowest_m &&
           std::all_of(separated.begin(), separated.end(), [&](const SeparatedMember& member) {
             return std::abs(offset - member.level_m) >= clearance;
           });
  };
  // A target once chosen stays while it can, or the formation would go up and down with every metre of
  // change. The planned altitude counts too: who is far from the lost one's level has no reason to leave it.
  if (clear(target_m, target_m == 0 ? limits.clearance_m : 0.8 * limits.clearance_m) &&
      FreeOfTraffic(now_m, target_m, body, strangers, limits.strangers)) {
    return target_m;
  }
  // Who is at the body's own level, give or take, is left rather than passed.
  const auto crosses_a_level = [&](double offset) {
    return std::any_of(separated.begin(), separated.end(), [&](const SeparatedMember& member) {
      return std::abs(member.level_m - now_m) > 0.5 * limits.clearance_m &&
             std::min(now_m, offset) < member.level_m && member.level_m < std::max(now_m, offset);
    });
  };
  // On the way to a free altitude it is better not to pass anybody; but better that than to stay.
  for (const bool may_cross : {false, true}) {
    for (const double step : kSteps) {
      std::vector<double> offsets;
      for (const SeparatedMember& member : separated) offsets.push_back(member.level_m + step);
      std::sort(offsets.begin(), offsets.end(),
                [&](double a, double b) { return std::abs(a - now_m) < std::abs(b - now_m); });
      for (const double offset : offsets) {
        if (clear(offset, std::min(limits.clearance_m, std::abs(step))) &&
            (may_cross || !crosses_a_level(offset)) &&
            FreeOfTraffic(now_m, offset, body, strangers, limits.strangers)) {
          return offset;
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace skein::controller

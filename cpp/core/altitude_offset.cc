#include "core/altitude_offset.h"

#include <algorithm>
#include <cmath>

namespace skein {

AltitudeRamp::AltitudeRamp(const AltitudeOffset& start, const AltitudeRampLimits& limits)
    : limits_(limits), now_(start), target_m_(start.height_m) {}

bool AltitudeRamp::settled() const { return now_.height_m == target_m_ && now_.rate_m_s == 0; }

void AltitudeRamp::Advance(double step_s) {
  // A gap in time is flown in steps short enough for the discrete braking below.
  constexpr double kLongestStep = 0.1;
  for (; step_s > kLongestStep && !settled(); step_s -= kLongestStep) Step(kLongestStep);
  if (step_s > 0) Step(std::min(step_s, kLongestStep));
}

void AltitudeRamp::Step(double step_s) {
  const double a = limits_.acceleration_m_s2;
  const double distance = target_m_ - now_.height_m;
  // Close enough to arrive within this step without exceeding the acceleration.
  if (std::abs(distance) <= a * step_s * step_s && std::abs(now_.rate_m_s) <= 2 * a * step_s) {
    now_ = {target_m_, 0, 0};
    return;
  }
  // The rate r' for the end of this step from which it can still stop at the target, in discrete time:
  // |distance| = (r + r') / 2 * step + r'^2 / (2 a), with r the rate now.
  const double towards = std::copysign(now_.rate_m_s, now_.rate_m_s * distance);
  const double half = 0.5 * a * step_s;
  const double stoppable =
      std::sqrt(std::max(0.0, half * half + 2 * a * std::abs(distance) - 2 * half * towards)) - half;
  const double wanted = std::copysign(1.0, distance) * std::min(stoppable, limits_.rate_m_s);
  const double change = std::clamp(wanted - now_.rate_m_s, -a * step_s, a * step_s);
  now_.acceleration_m_s2 = change / step_s;
  now_.height_m += (now_.rate_m_s + 0.5 * change) * step_s;
  now_.rate_m_s += change;
}

double AltitudeRamp::RemainingTime() const {
  const double a = limits_.acceleration_m_s2;
  const double distance = target_m_ - now_.height_m;
  if (distance == 0 && now_.rate_m_s == 0) return 0;
  const double towards = std::copysign(1.0, distance) * now_.rate_m_s;
  // A rate the wrong way has to be stopped first, which adds to the way.
  const double stop_time = std::max(0.0, -towards) / a;
  const double way = std::abs(distance) + 0.5 * stop_time * std::max(0.0, -towards);
  const double start = std::max(0.0, towards);
  const double peak = std::min(limits_.rate_m_s, std::sqrt(a * way + 0.5 * start * start));
  const double ramps = (std::max(0.0, peak * peak - start * start) + peak * peak) / (2 * a);
  const double cruise = std::max(0.0, way - ramps) / peak;
  return stop_time + std::max(0.0, peak - start) / a + cruise + peak / a;
}

}  // namespace skein

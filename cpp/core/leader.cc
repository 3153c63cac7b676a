#include "core/leader.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr double kHistory_s = 10;
constexpr double kStep_s = 0.25;

/// ds/dt = v(s) by the fourth-order Runge-Kutta method, in one step.
double Flown(const Path& path, double arc_m, double step_s) {
  const double k1 = path.SpeedAt(arc_m);
  const double k2 = path.SpeedAt(arc_m + 0.5 * step_s * k1);
  const double k3 = path.SpeedAt(arc_m + 0.5 * step_s * k2);
  const double k4 = path.SpeedAt(arc_m + step_s * k3);
  return arc_m + step_s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

double FlownFor(const Path& path, double arc_m, double duration_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(duration_s) / kStep_s)));
  for (int i = 0; i < steps; ++i) arc_m = Flown(path, arc_m, duration_s / steps);
  return arc_m;
}

}  // namespace

VirtualLeader::VirtualLeader(Path path, double arc_m, double time_s)
    : path_(std::move(path)), history_{{time_s, arc_m}} {}

void VirtualLeader::AdvanceTo(double time_s) {
  while (this->time_s() < time_s) {
    const double step = std::min(kStep_s, time_s - this->time_s());
    const double next = step < kStep_s ? time_s : this->time_s() + kStep_s;
    history_.push_back({next, Flown(path_, arc_m(), step)});
    // The last moment from before the history's beginning stays: ArcAt() goes on from it.
    while (history_.size() > 2 && history_[1].time_s <= next - kHistory_s) history_.pop_front();
  }
}

double VirtualLeader::ArcAt(double time_s) const {
  const auto after = std::upper_bound(history_.begin(), history_.end(), time_s,
                                      [](double time, const Moment& moment) { return time < moment.time_s; });
  const Moment& from = after == history_.begin() ? *after : *(after - 1);
  return from.time_s == time_s ? from.arc_m : FlownFor(path_, from.arc_m, time_s - from.time_s);
}

}  // namespace skein

#include "core/path_departure.h"

#include <algorithm>
#include <utility>

namespace skein {

Departure Depart(const Path& current, double arc_m, double keep_behind_m, const PathLimits& limits) {
  const double from = arc_m + std::max(0.0, limits.foremost_m);
  return {current, std::min(arc_m - keep_behind_m, arc_m + limits.hindmost_m), current.At(from)};
}

Path Assemble(const Departure& departure, const Draft& draft, double profile_end_m, const PathSection& next,
              std::optional<double> loop_start_m) {
  PathSection whole = Section(departure.current, departure.keep_from_m, departure.start.arc_m);
  whole.knots.pop_back();  // the draft begins with it
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(whole.pieces, draft.chain.pieces());
  append(whole.knots, Merge(draft.up, draft.speed, departure.start.arc_m, profile_end_m));
  append(whole.pieces, next.pieces);
  if (!next.knots.empty()) {
    whole.knots.insert(whole.knots.end(), next.knots.begin() + 1, next.knots.end());
  }
  return Path(whole.start_arc_m, std::move(whole.pieces), std::move(whole.knots), loop_start_m);
}

double SpeedChangeFrom(const Departure& departure, const PathLimits& limits) {
  const double start = departure.start.arc_m;
  const double hindmost = start - std::max(0.0, limits.foremost_m) + std::min(0.0, limits.hindmost_m);
  const bool wide = limits.most_left_m > 0 || limits.most_right_m > 0;
  return wide && Curves(departure.current, hindmost, start) ? start + (start - hindmost) : start;
}

TurnRate RateOf(double radius_m, double max_speed_m_s, double reserve, const PathLimits& limits) {
  const LeaderMotion motion{max_speed_m_s, max_speed_m_s, reserve * limits.max_acceleration_m_s2};
  return {1 / radius_m, *MostSlope(limits, motion, 1 / radius_m)};
}

}  // namespace skein

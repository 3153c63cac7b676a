#include <algorithm>
#include <cmath>
#include <utility>

#include "core/path_departure.h"

namespace skein {
namespace {

/// Of the acceleration limit, kept from the curvature ramps for changes of speed and climbs still going on;
/// the next one is tried when the one before did not do.
constexpr double kReserves[] = {0, 0.4, 0.7};

/// Of the acceleration limit, what a change to the loiter speed uses.
constexpr double kSpeedShare = 0.5;

/// Changes of speed smaller than this are not worth a straight leg.
constexpr double kSameSpeed_m_s = 0.01;

struct Loitering {
  Path path;
  double on_circle_m;
};

Loitering Enter(const Departure& departure, double radius_m, double reserve, const PathLimits& limits) {
  const PathPoint& start = departure.start;
  Draft draft(departure);
  const double up_settle = ClimbSettleLength(UpOf(start), start.speed_m_s, limits);
  Add(draft.up, start.arc_m + up_settle, {start.up_m + SettleRise(UpOf(start), up_settle)});
  const double speed_settle = SpeedSettleLength(SpeedOf(start));
  const double settled = start.speed_m_s + SettleRise(SpeedOf(start), speed_settle);
  Add(draft.speed, start.arc_m + speed_settle, {settled});

  const double speed = LoiterSpeed(limits, settled);
  const double fastest = std::max({start.speed_m_s, settled, speed});
  const TurnRate rate = RateOf(radius_m, fastest, reserve, limits);
  double curvature = start.curvature_per_m;
  if (std::abs(speed - settled) > kSameSpeed_m_s) {
    // The circle is for the loiter speed; until that is flown, straight on.
    draft.chain.Lay(std::abs(curvature) / rate.slope_per_m2, curvature, 0);
    curvature = 0;
    const double from =
        std::max({draft.chain.arc_m(), draft.speed.back().arc_m, SpeedChangeFrom(departure, limits)});
    const double to = from + SpeedChangeLength(settled, speed, kSpeedShare, limits);
    Add(draft.speed, from, {settled});
    Add(draft.speed, to, {speed});
    // The last slot, too, is to have the new speed when the first one turns.
    draft.chain.LayStraight(to + std::max(0.0, limits.foremost_m) - draft.chain.arc_m());
  }
  const double circle = std::copysign(rate.curvature_per_m, start.curvature_per_m < 0 ? -1 : 1);
  draft.chain.Lay(std::abs(circle - curvature) / rate.slope_per_m2, curvature, circle);
  const double on_circle = draft.chain.arc_m();
  draft.chain.Lay(2 * M_PI * radius_m, circle, circle);
  return {Assemble(departure, draft, std::max(draft.up.back().arc_m, draft.speed.back().arc_m)), on_circle};
}

}  // namespace

PathResult Loiter(const Path& current, double arc_m, double keep_behind_m, const PathLimits& limits) {
  const Departure departure = Depart(current, arc_m, keep_behind_m, limits);
  const double speed = departure.start.speed_m_s;
  const std::optional<double> radius = LoiterRadius(limits, speed);
  if (!radius) return {std::nullopt, "no speed is within the limits of all slots"};
  for (const double reserve : kReserves) {
    Loitering loitering = Enter(departure, *radius, reserve, limits);
    const bool last = reserve == std::end(kReserves)[-1];
    // A formation that is told to hold holds, even if what it was doing already was too much for it.
    if (last || !FirstExcess(loitering.path, limits, departure.start.arc_m, loitering.on_circle_m)) {
      return {std::move(loitering.path), ""};
    }
  }
  return {};
}

}  // namespace skein

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/path_planning.h"
#include "core/path_profile.h"

namespace skein {
namespace {

/// What the leader does while slots turn depends on the path, and ramps on what the leader does: planned
/// again so often at most.
constexpr int kMostPasses = 6;

PathResult Refused(size_t leg, const std::string& reason) {
  return {std::nullopt, "leg " + std::to_string(leg + 1) + ": " + reason};
}

/// Empty when the numbers of a leg make sense.
std::string Nonsense(const PathLeg& leg) {
  for (const double value :
       {leg.length_m, leg.turn_rad, leg.turn_radius_m, leg.ramp_s, leg.climb_m, leg.speed_m_s}) {
    if (!std::isfinite(value)) return "a number is not finite";
  }
  if (leg.turn_rad == 0 && !(leg.length_m > 0)) return "needs a length or a turn";
  if (leg.turn_radius_m < 0 || leg.ramp_s < 0 || leg.speed_m_s < 0)
    return "a radius, ramp or speed is negative";
  return {};
}

/// Altitudes and speeds before the first leg and after each.
struct Levels {
  std::vector<double> up_m;
  std::vector<double> speed_m_s;
};

Levels LevelsOf(double up_m, double speed_m_s, const std::vector<PathLeg>& legs) {
  Levels levels{{up_m}, {speed_m_s}};
  for (const PathLeg& leg : legs) {
    levels.up_m.push_back(levels.up_m.back() + leg.climb_m);
    levels.speed_m_s.push_back(leg.speed_m_s > 0 ? leg.speed_m_s : levels.speed_m_s.back());
  }
  return levels;
}

std::string TooShort(double length_m, double climb_m, double from_m_s, double to_m_s,
                     const PathLimits& limits) {
  const double for_climb = ClimbLength(climb_m, std::max(from_m_s, to_m_s), limits);
  if (length_m < for_climb) {
    return "too short for a climb or descent of " + Metres(std::abs(climb_m)) + ": it is " +
           Metres(length_m) + " long and needs " + Metres(for_climb);
  }
  const double for_speed = SpeedChangeLength(from_m_s, to_m_s, 1, limits);
  if (length_m < for_speed) {
    return "too short for the change of speed: it is " + Metres(length_m) + " long and needs " +
           Metres(for_speed);
  }
  return {};
}

}  // namespace

PathResult PlanLegs(const Eigen::Vector2d& start, double course_rad, double up_m, double speed_m_s,
                    const std::vector<PathLeg>& legs, const PathLimits& limits) {
  if (!start.allFinite() || !std::isfinite(course_rad) || !std::isfinite(up_m) || !std::isfinite(speed_m_s) ||
      !(speed_m_s > 0)) {
    return {std::nullopt, "the start of the path makes no sense"};
  }
  if (legs.empty()) return {Path::Straight(start, course_rad, up_m, speed_m_s), ""};
  const Levels levels = LevelsOf(up_m, speed_m_s, legs);
  std::vector<LeaderMotion> motions;
  for (size_t i = 0; i < legs.size(); ++i) {
    if (const std::string nonsense = Nonsense(legs[i]); !nonsense.empty()) return Refused(i, nonsense);
    const auto [least, most] = std::minmax(levels.speed_m_s[i], levels.speed_m_s[i + 1]);
    motions.push_back({least, most, 0});
  }

  for (int pass = 1;; ++pass) {
    PieceChain chain({start, course_rad});
    std::vector<double> ends_m;
    std::vector<ProfileKnot> knots{{0, up_m, speed_m_s}};
    for (size_t i = 0; i < legs.size(); ++i) {
      if (legs[i].turn_rad == 0) {
        chain.LayStraight(legs[i].length_m);
      } else {
        const TurnResult planned =
            PlanTurn({legs[i].turn_rad, legs[i].turn_radius_m, legs[i].ramp_s}, motions[i], limits);
        if (!planned.reason.empty()) return Refused(i, planned.reason);
        chain.Lay(planned.turn);
      }
      const double length = chain.arc_m() - knots.back().arc_m;
      const std::string too_short =
          TooShort(length, legs[i].climb_m, levels.speed_m_s[i], levels.speed_m_s[i + 1], limits);
      if (!too_short.empty()) return Refused(i, too_short);
      knots.push_back({chain.arc_m(), levels.up_m[i + 1], levels.speed_m_s[i + 1]});
      ends_m.push_back(chain.arc_m());
    }
    Path path(0, chain.pieces(), knots, std::nullopt);

    bool settled = true;
    for (size_t i = 0; i < legs.size(); ++i) {
      if (legs[i].turn_rad == 0) continue;
      const LeaderMotion motion = MotionWhile(path, limits, i == 0 ? 0 : ends_m[i - 1], ends_m[i]);
      if (Covers(motions[i], motion)) continue;
      motions[i] = Widened(motions[i], motion);
      settled = false;
    }
    if (!settled && pass < kMostPasses) continue;
    const auto excess = FirstExcess(path, limits, 0, path.end_arc_m());
    if (!excess) return {std::move(path), ""};
    const auto leg = std::lower_bound(ends_m.begin(), ends_m.end(), excess->arc_m);
    return Refused(static_cast<size_t>(std::min(leg, ends_m.end() - 1) - ends_m.begin()), excess->what);
  }
}

}  // namespace skein

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/path_departure.h"
#include "core/path_planning.h"

namespace skein {
namespace {

/// How gently a join is flown. The next one is tried when the one before asks too much of a slot somewhere.
struct Effort {
  double reserve;  ///< of the acceleration limit, for changes of speed and altitude
  double widen;    ///< factor of the radius of turns
  double stretch;  ///< factor of the length of changes of speed and altitude
};
constexpr Effort kEfforts[] = {{0, 1, 1}, {0.4, 1.2, 1.3}, {0.6, 1.5, 1.8}, {0.75, 2, 3}, {0.85, 4, 6}};

/// Least reserves when speed or altitude change at all, and how much of its reserve a change of speed uses.
constexpr double kSpeedReserve = 0.5;
constexpr double kClimbReserve = 0.2;
constexpr double kUsed = 0.8;

/// Straight leads tried, in turn radii, where no turn-straight-turn leads to the target.
constexpr double kLeads[] = {0, 0.5, 1, 2, 4, 8};

/// Full circles flown at most to gain length for a climb.
constexpr int kMostCircles = 1000;

constexpr double kSame = 0.01;  ///< m/s or m

/// A quantity from a departure to a target: levels off, changes, and takes up the target's slope.
struct Change {
  Jet from;
  Jet to;
  double settle_m = 0;   ///< from the start
  double take_up_m = 0;  ///< until the end
  double level_from = 0;
  double level_to = 0;
};

Change ChangeBetween(const Jet& from, const Jet& to, double settle_m, double take_up_m) {
  // Seen backwards from the target the slope has the other sign.
  return {from,
          to,
          settle_m,
          take_up_m,
          from.value + SettleRise(from, settle_m),
          to.value + SettleRise({to.value, -to.slope, to.rate}, take_up_m)};
}

/// Marks of a change from start_m to end_m that begins at from_m at the earliest.
std::vector<Mark> MarksOf(const Change& change, double start_m, double from_m, double end_m) {
  std::vector<Mark> marks{{start_m, change.from}};
  Add(marks, start_m + change.settle_m, {change.level_from});
  Add(marks, std::max(from_m, start_m + change.settle_m), {change.level_from});
  Add(marks, end_m - change.take_up_m, {change.level_to});
  Add(marks, end_m, change.to);
  return marks;
}

class Joining {
 public:
  Joining(const Departure& departure, const Path& next, const PathPoint& target, const PathLimits& limits)
      : departure_(departure), next_(next), target_(target), limits_(limits) {
    const PathPoint& start = departure.start;
    up_ = ChangeBetween(UpOf(start), UpOf(target), ClimbSettleLength(UpOf(start), start.speed_m_s, limits),
                        ClimbSettleLength(UpOf(target), target.speed_m_s, limits));
    speed_ = ChangeBetween(SpeedOf(start), SpeedOf(target), SpeedSettleLength(SpeedOf(start)),
                           SpeedSettleLength(SpeedOf(target)));
    const auto [slowest, fastest] =
        std::minmax({start.speed_m_s, speed_.level_from, speed_.level_to, target.speed_m_s});
    motion_ = {slowest, fastest, 0};
    speed_from_m_ = SpeedChangeFrom(departure, limits);
  }

  PathResult Plan() const {
    const auto left = LeastRadius(limits_, motion_, 1), right = LeastRadius(limits_, motion_, -1);
    const auto circle = LoiterRadius(limits_, motion_.max_speed_m_s);
    if (!left || !right || !circle) {
      return {std::nullopt, "no turn is possible at the speeds of the two paths"};
    }
    const double radius = kComfortRadius * std::max(*left, *right);
    std::string reason;
    for (const Effort& effort : kEfforts) {
      PathResult result = Try(effort, radius * effort.widen, std::max(radius, *circle) * effort.widen);
      if (result.path) return result;
      reason = std::move(result.reason);
    }
    return {std::nullopt, "no way to the path: " + reason};
  }

 private:
  bool ChangesSpeed() const { return std::abs(speed_.level_to - speed_.level_from) > kSame; }
  bool ChangesUp() const {
    return std::abs(up_.level_to - up_.level_from) > kSame || up_.settle_m > 0 || up_.take_up_m > 0;
  }

  double LeastLength(const Effort& effort, double reserve) const {
    const double climb = ClimbLength(up_.level_to - up_.level_from, motion_.max_speed_m_s, limits_);
    const double for_up = up_.settle_m + effort.stretch * climb + up_.take_up_m;
    double for_speed = speed_.settle_m + speed_.take_up_m;
    if (ChangesSpeed()) {
      for_speed =
          std::max(speed_.settle_m, speed_from_m_ - departure_.start.arc_m) + speed_.take_up_m +
          effort.stretch * SpeedChangeLength(speed_.level_from, speed_.level_to, kUsed * reserve, limits_);
    }
    return std::max(for_up, for_speed);
  }

  /// Unwinds the curvature, flies so many full circles, and connects.
  std::optional<PieceChain> Lay(int circles, const TurnRate& tight, const TurnRate& wide) const {
    const double curvature = departure_.start.curvature_per_m;
    for (const double lead : kLeads) {
      PieceChain chain({departure_.start.position, departure_.start.course_rad}, departure_.start.arc_m);
      chain.Lay(std::abs(curvature) / tight.slope_per_m2, curvature, 0);
      chain.LayStraight(lead / tight.curvature_per_m);
      const double side = curvature < 0 ? -1 : 1;
      if (circles > 0)
        chain.Lay(MakeTurn(side * circles * 2 * M_PI, wide.curvature_per_m, wide.slope_per_m2));
      const auto way = Connect(chain.end(), {target_.position, target_.course_rad}, tight, wide);
      if (!way) continue;
      chain.Lay(way->first);
      chain.LayStraight(way->straight_m);
      chain.Lay(way->second);
      return chain;
    }
    return std::nullopt;
  }

  PathResult Try(const Effort& effort, double radius_m, double wide_radius_m) const {
    double reserve = effort.reserve;
    if (ChangesSpeed()) reserve = std::max(reserve, kSpeedReserve);
    if (ChangesUp()) reserve = std::max(reserve, kClimbReserve);
    const TurnRate tight = RateOf(radius_m, motion_.max_speed_m_s, reserve, limits_);
    const TurnRate wide = RateOf(wide_radius_m, motion_.max_speed_m_s, reserve, limits_);
    const double start = departure_.start.arc_m;
    const double least = LeastLength(effort, reserve);
    int circles = 0;
    std::optional<PieceChain> chain = Lay(circles, tight, wide);
    while (chain && chain->arc_m() - start < least && circles < kMostCircles) {
      circles +=
          std::max(1, static_cast<int>((least - (chain->arc_m() - start)) / (2 * M_PI * wide_radius_m)));
      chain = Lay(circles, tight, wide);
    }
    if (!chain || chain->arc_m() - start < least) return {std::nullopt, "no turns lead there"};
    return Checked(*chain, std::abs(departure_.start.curvature_per_m) / tight.slope_per_m2);
  }

  PathResult Checked(const PieceChain& chain, double unwind_m) const {
    Draft draft(departure_);
    draft.chain = chain;
    const double start = departure_.start.arc_m, end = chain.arc_m();
    draft.up = MarksOf(up_, start, start, end);
    draft.speed = MarksOf(speed_, start, ChangesSpeed() ? speed_from_m_ : start, end);
    std::optional<double> loop_start;
    const PathSection rest = Rest(end, chain.end().course_rad, loop_start);
    Path path = Assemble(departure_, draft, end, rest, loop_start);

    const double ahead = std::max(0.0, limits_.foremost_m);
    // What is flown already may be too much, after an edit of the formation: then the way out of it is not to
    // blame.
    const bool blameless = !FirstExcess(departure_.current, limits_, start, start);
    auto excess = FirstExcess(path, limits_, blameless ? start : start + unwind_m, end + ahead);
    const double behind = start - ahead + std::min(0.0, limits_.hindmost_m);
    if (!excess && !FirstExcess(departure_.current, limits_, behind, start)) {
      excess = FirstExcess(path, limits_, behind, start);
    }
    if (excess) return {std::nullopt, excess->what};
    PathResult result{std::move(path), ""};
    result.joins_at_m = end;
    result.shift_m = end - target_.arc_m;
    return result;
  }

  /// What is left of the next path, from the target on, moved to where the join ends.
  PathSection Rest(double end_m, double course_rad, std::optional<double>& loop_start_m) const {
    double to = std::max({target_.arc_m + 1, next_.end_arc_m(), next_.profile().back().arc_m});
    if (next_.closed()) {
      const double loop = std::max(target_.arc_m, *next_.loop_start_m());
      loop_start_m = end_m + loop - target_.arc_m;
      to = loop + next_.lap_m();
    }
    PathSection rest = Section(next_, target_.arc_m, to);
    const double turns = 2 * M_PI * std::round((course_rad - target_.course_rad) / (2 * M_PI));
    for (PathPiece& piece : rest.pieces) piece.start_course_rad += turns;
    for (ProfileKnot& knot : rest.knots) knot.arc_m += end_m - target_.arc_m;
    return rest;
  }

  const Departure& departure_;
  const Path& next_;
  const PathPoint& target_;
  const PathLimits& limits_;
  Change up_;
  Change speed_;
  LeaderMotion motion_;
  double speed_from_m_ = 0;
};

}  // namespace

PathResult Join(const Path& current, double arc_m, const Path& next, double next_arc_m, double keep_behind_m,
                const PathLimits& limits) {
  const std::optional<double> straight = StraightPoint(next, next_arc_m);
  if (!straight) return {std::nullopt, "the path is nowhere straight, there is no place to join it"};
  const Departure departure = Depart(current, arc_m, keep_behind_m, limits);
  const PathPoint target = next.At(*straight);
  return Joining(departure, next, target, limits).Plan();
}

}  // namespace skein

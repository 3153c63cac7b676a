#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/path_planning.h"
#include "core/path_profile.h"

namespace skein {
namespace {

constexpr double kSamePlace_m = 1;
constexpr double kTurnsBack_rad = 175 * M_PI / 180;
constexpr int kMostPasses = 6;

/// Climbs that also use the corners need this much more length than on the straight: slots on the inside have
/// less of it.
constexpr double kCornerClimb = 1.3;

/// Of the acceleration limit, what a change of speed uses that goes on while slots are in a turn.
constexpr double kCornerSpeedShare = 0.5;

struct Leg {
  Eigen::Vector2d from{0, 0};
  double length_m = 0;
  double course_rad = 0;
};

/// A waypoint with its turn (none at the ends of an open path), and where on the path that lies.
struct Corner {
  TurnRequest request;
  LeaderMotion motion;
  double comfort = 1;
  Turn turn;
  double tangent_m = 0;  ///< from the waypoint to the start and end of its turn
  double start_m = 0;
  double end_m = 0;

  double middle_m() const { return 0.5 * (start_m + end_m); }
};

/// How altitude or speed changes along a leg: between these arc lengths.
struct Span {
  double from_m;
  double to_m;
};

class WaypointPlan {
 public:
  WaypointPlan(const std::vector<Waypoint>& waypoints, bool closed, const PathLimits& limits)
      : waypoints_(waypoints), closed_(closed), limits_(limits), corners_(waypoints.size()) {}

  PathResult Plan() {
    if (!Check() || !MakeLegs()) return Refusal();
    for (int pass = 1;; ++pass) {
      if (!PlanTurns() || !Fit()) return Refusal();
      std::optional<Path> path = Lay();
      if (!path) return Refusal();
      if (!Settled(*path) && pass < kMostPasses) continue;
      return Checked(std::move(*path));
    }
  }

 private:
  size_t Next(size_t i) const { return (i + 1) % waypoints_.size(); }
  bool Turns(size_t i) const { return closed_ || (i > 0 && i + 1 < waypoints_.size()); }
  std::string Name(size_t i) const { return "waypoint " + std::to_string(i + 1); }
  std::string LegName(size_t i) const {
    return "leg " + std::to_string(i + 1) + " (waypoint " + std::to_string(i + 1) + " to " +
           std::to_string(Next(i) + 1) + ")";
  }

  // Each step looks at all waypoints before it gives up, so that a person can mend them all at once.
  void Refuse(std::string text) { problems_.push_back({0, false, std::move(text)}); }
  void RefuseWaypoint(size_t i, const std::string& why) {
    problems_.push_back({i, false, Name(i) + ": " + why});
  }
  void RefuseLeg(size_t i, const std::string& why) {
    problems_.push_back({i, true, LegName(i) + ": " + why});
  }
  bool AllGood() const { return problems_.empty(); }
  PathResult Refusal() const {
    PathResult result{std::nullopt, problems_.front().text};
    result.problems = problems_;
    return result;
  }

  bool Check() {
    const size_t least = closed_ ? 3 : 2;
    if (waypoints_.size() < least) {
      Refuse((closed_ ? "a closed path needs at least 3 waypoints, not "
                      : "a path needs at least 2 waypoints, not ") +
             std::to_string(waypoints_.size()));
      return false;
    }
    for (size_t i = 0; i < waypoints_.size(); ++i) {
      const Waypoint& point = waypoints_[i];
      const auto numbers = {point.east_m, point.north_m, point.up_m, point.speed_m_s, point.turn_radius_m};
      if (!std::ranges::all_of(numbers, [](double value) { return std::isfinite(value); })) {
        RefuseWaypoint(i, "a number is not finite");
      } else if (point.turn_radius_m < 0) {
        RefuseWaypoint(i, "the turn radius is negative");
      } else if (point.speed_m_s < limits_.min_speed_m_s || point.speed_m_s > limits_.max_speed_m_s) {
        std::ostringstream text;
        text << point.speed_m_s << " m/s is not within what all can fly with a margin, "
             << limits_.min_speed_m_s << " to " << limits_.max_speed_m_s << " m/s";
        RefuseWaypoint(i, text.str());
      }
    }
    return AllGood();
  }

  bool MakeLegs() {
    const size_t count = waypoints_.size() - (closed_ ? 0 : 1);
    for (size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d from(waypoints_[i].east_m, waypoints_[i].north_m);
      const Eigen::Vector2d way =
          Eigen::Vector2d(waypoints_[Next(i)].east_m, waypoints_[Next(i)].north_m) - from;
      if (way.norm() < kSamePlace_m) RefuseLeg(i, "both waypoints are at the same place");
      legs_.push_back({from, way.norm(), std::atan2(way.y(), way.x())});
    }
    for (size_t i = 0; i < waypoints_.size(); ++i) {
      const double speed = waypoints_[i].speed_m_s;
      corners_[i].motion = {speed, speed, 0};
      if (!Turns(i)) continue;
      const double before = legs_[(i + legs_.size() - 1) % legs_.size()].course_rad;
      const double turn = std::remainder(legs_[i].course_rad - before, 2 * M_PI);
      if (std::abs(turn) > kTurnsBack_rad) {
        RefuseWaypoint(i, "the path turns back on itself there, insert a waypoint to the side");
      }
      corners_[i].request = {turn, waypoints_[i].turn_radius_m, 0};
    }
    return AllGood();
  }

  /// The turn at a waypoint at some comfort.
  void PlanTurn(size_t i, double comfort) {
    Corner& corner = corners_[i];
    if (corner.request.turn_rad == 0) return;
    const TurnResult planned = skein::PlanTurn(corner.request, corner.motion, limits_, comfort);
    if (!planned.reason.empty()) return RefuseWaypoint(i, planned.reason);
    corner.turn = planned.turn;
    corner.tangent_m = 0.5 * Chord(planned.turn) / std::cos(0.5 * planned.turn.turn_rad);
  }

  bool PlanTurns() {
    for (size_t i = 0; i < corners_.size(); ++i) {
      corners_[i].comfort = 1;
      PlanTurn(i, 1);
    }
    return AllGood();
  }

  /// Of a leg, what its two turns take at the same comfort.
  double Taken(size_t leg, double comfort) {
    // A comfortable turn was possible, so tighter ones are.
    PlanTurn(leg, comfort);
    PlanTurn(Next(leg), comfort);
    return corners_[leg].tangent_m + corners_[Next(leg)].tangent_m;
  }

  /// Tightens turns that have no radius of their own until they fit on their legs.
  bool Fit() {
    for (size_t leg = 0; leg < legs_.size(); ++leg) {
      const double length = legs_[leg].length_m;
      double comfort = 1;
      if (Taken(leg, 1) > length) {
        const double least = Taken(leg, 0);
        if (least > length) {
          RefuseLeg(leg, "it is " + Metres(length) + " long and too short for its turns, which need " +
                             Metres(least) +
                             "; move the waypoints apart, fly slower or bring the slots closer together");
          continue;
        }
        double low = 0, high = 1;
        for (int i = 0; i < 40; ++i) {
          const double middle = 0.5 * (low + high);
          (Taken(leg, middle) > length ? high : low) = middle;
        }
        comfort = low;
      }
      for (const size_t i : {leg, Next(leg)}) corners_[i].comfort = std::min(corners_[i].comfort, comfort);
    }
    for (size_t i = 0; i < corners_.size(); ++i) PlanTurn(i, corners_[i].comfort);
    return AllGood();
  }

  /// Altitude changes on the straight, where that is long enough, else from the middle of one turn to the
  /// middle of the next.
  std::optional<Span> ClimbSpan(size_t leg, double start_m, double end_m, double straight_from,
                                double straight_to) {
    const Waypoint &from = waypoints_[leg], &to = waypoints_[Next(leg)];
    const double climb = to.up_m - from.up_m;
    const double least = ClimbLength(climb, std::max(from.speed_m_s, to.speed_m_s), limits_);
    if (straight_to - straight_from >= least) return Span{straight_from, straight_to};
    if (end_m - start_m >= kCornerClimb * least) return Span{start_m, end_m};
    RefuseLeg(leg, "too short for a climb or descent of " + Metres(std::abs(climb)) + ", it needs " +
                       Metres(least) + " of straight and has " + Metres(straight_to - straight_from));
    return std::nullopt;
  }

  /// Speed changes while all slots are on the straight, where that is long enough.
  std::optional<Span> SpeedSpan(size_t leg, double start_m, double end_m, double straight_from,
                                double straight_to) {
    const double from = waypoints_[leg].speed_m_s, to = waypoints_[Next(leg)].speed_m_s;
    const double out_of_turn = std::max(start_m, straight_from - limits_.hindmost_m);
    const double into_turn = std::min(end_m, straight_to - limits_.foremost_m);
    if (into_turn - out_of_turn >= SpeedChangeLength(from, to, 1, limits_))
      return Span{out_of_turn, into_turn};
    const double least = SpeedChangeLength(from, to, kCornerSpeedShare, limits_);
    if (end_m - start_m >= least) return Span{start_m, end_m};
    RefuseLeg(leg, "too short for the change of speed, it is " + Metres(end_m - start_m) +
                       " long and needs " + Metres(least));
    return std::nullopt;
  }

  /// From the end of the first turn (or the first waypoint), leg by leg.
  std::optional<Path> Lay() {
    const Leg& first = legs_.front();
    PieceChain chain({first.from + corners_[0].tangent_m * Direction(first.course_rad), first.course_rad});
    std::vector<Mark> up, speed;
    corners_[0].end_m = 0;
    corners_[0].start_m = -corners_[0].turn.length_m();
    const double first_middle = corners_[0].middle_m();
    for (size_t leg = 0; leg < legs_.size(); ++leg) {
      const size_t to = Next(leg);
      const double start = leg == 0 ? first_middle : corners_[leg].middle_m();
      const double straight_from = chain.arc_m();
      chain.LayStraight(legs_[leg].length_m - corners_[leg].tangent_m - corners_[to].tangent_m);
      corners_[to].start_m = chain.arc_m();
      chain.Lay(corners_[to].turn);
      corners_[to].end_m = chain.arc_m();
      const double end = corners_[to].middle_m();
      const auto climb = ClimbSpan(leg, start, end, straight_from, corners_[to].start_m);
      const auto change = SpeedSpan(leg, start, end, straight_from, corners_[to].start_m);
      if (!climb || !change) continue;
      Add(up, climb->from_m, {waypoints_[leg].up_m});
      Add(up, climb->to_m, {waypoints_[to].up_m});
      Add(speed, change->from_m, {waypoints_[leg].speed_m_s});
      Add(speed, change->to_m, {waypoints_[to].speed_m_s});
    }
    if (!AllGood()) return std::nullopt;
    const double length = chain.arc_m();
    if (closed_) {
      Wind(up, length);
      Wind(speed, length);
    }
    return Path(0, chain.pieces(), Merge(up, speed, 0, length), closed_ ? std::optional(0.0) : std::nullopt);
  }

  /// Repeats the marks of one lap in the lap before and after.
  static void Wind(std::vector<Mark>& marks, double lap_m) {
    const std::vector<Mark> once = std::move(marks);
    marks.clear();
    for (const double lap : {-1, 0, 1}) {
      for (const Mark& mark : once) Add(marks, mark.arc_m + lap * lap_m, mark.jet);
    }
  }

  /// Whether the turns are made for what the leader really does while slots are in them; else plans for that.
  bool Settled(const Path& path) {
    bool settled = true;
    // On the second lap: what the leader did before the first one does not come again.
    const double lap = path.lap_m();
    for (Corner& corner : corners_) {
      if (corner.turn.turn_rad == 0) continue;
      const LeaderMotion motion = MotionWhile(path, limits_, corner.start_m + lap, corner.end_m + lap);
      if (Covers(corner.motion, motion)) continue;
      corner.motion = Widened(corner.motion, motion);
      settled = false;
    }
    return settled;
  }

  PathResult Checked(Path path) {
    if (closed_ && path.lap_m() < LeastLoop(limits_)) {
      Refuse("the loop is " + Metres(path.lap_m()) + " long, the formation with its clearance " +
             Metres(LeastLoop(limits_)) + "; move the waypoints apart");
      return Refusal();
    }
    const double lap = path.lap_m();
    if (const auto excess = FirstExcess(path, limits_, lap, path.end_arc_m() + lap)) {
      RefuseAt(excess->arc_m - lap, excess->what);
      return Refusal();
    }
    PathResult result{std::move(path), ""};
    if (!closed_) {
      const Path& whole = *result.path;
      result = Loiter(whole, whole.end_arc_m(), whole.end_arc_m() - whole.start_arc_m(), limits_);
      if (!result.path) {
        RefuseWaypoint(waypoints_.size() - 1, result.reason);
        return Refusal();
      }
    }
    for (const Corner& corner : corners_) result.waypoint_arcs_m.push_back(corner.middle_m());
    return result;
  }

  void RefuseAt(double arc_m, const std::string& why) {
    for (size_t leg = 0; leg < legs_.size(); ++leg) {
      if (arc_m < corners_[Next(leg)].start_m) return RefuseLeg(leg, why);
      if (arc_m <= corners_[Next(leg)].end_m) return RefuseWaypoint(Next(leg), why);
    }
    RefuseLeg(legs_.size() - 1, why);
  }

  const std::vector<Waypoint>& waypoints_;
  const bool closed_;
  const PathLimits& limits_;
  std::vector<Corner> corners_;
  std::vector<Leg> legs_;
  std::vector<PathProblem> problems_;
};

}  // namespace

PathResult PlanWaypoints(const std::vector<Waypoint>& waypoints, bool closed, const PathLimits& limits) {
  return WaypointPlan(waypoints, closed, limits).Plan();
}

}  // namespace skein

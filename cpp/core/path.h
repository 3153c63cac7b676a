#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/formation.h"
#include "core/vehicle.h"

namespace skein {

/// A point that a path goes by. The corner is cut by an arc (fly-by), the path does not touch the point
/// itself.
struct Waypoint {
  double east_m = 0;
  double north_m = 0;
  double up_m = 0;
  double speed_m_s = 50;     ///< of the virtual leader, > 0
  double turn_radius_m = 0;  ///< of the arc at this corner; 0: the smallest that all can fly in comfort
};

/// The other way to give a path: straight legs and turns, one after the other, from a start pose.
struct PathLeg {
  double length_m = 0;       ///< of a straight leg; unused in a turn
  double turn_rad = 0;       ///< left positive; 0: a straight leg
  double turn_radius_m = 0;  ///< of a turn
  double ramp_s = 0;         ///< time of each curvature ramp of a turn; 0: what the limits ask for
  double climb_m = 0;        ///< change of planned altitude along the leg
  double speed_m_s = 0;      ///< planned speed at its end; 0: as before
};

/// Curvature is linear in arc length along a piece (straight, arc or clothoid).
struct PathPiece {
  double length_m = 0;
  Eigen::Vector2d start{0, 0};       ///< east, north
  double start_course_rad = 0;       ///< unwrapped along the path
  double start_curvature_per_m = 0;  ///< left positive
  double end_curvature_per_m = 0;
};

/// A knot of the altitude and speed profiles over arc length. Between knots both are the quintic that meets
/// value, slope and slope rate at either end; all slopes zero gives level ends. A quintic cut in two stays
/// the same curve.
struct ProfileKnot {
  double arc_m = 0;
  double up_m = 0;
  double speed_m_s = 0;
  double up_slope = 0;                  ///< d up / d s
  double up_slope_rate_per_m = 0;       ///< d^2 up / d s^2
  double speed_slope_per_s = 0;         ///< d speed / d s
  double speed_slope_rate_per_m_s = 0;  ///< d^2 speed / d s^2
};

/// Everything about a path at one arc length.
struct PathPoint {
  double arc_m = 0;
  Eigen::Vector2d position{0, 0};       ///< east, north
  double course_rad = 0;                ///< theta, unwrapped
  double curvature_per_m = 0;           ///< kappa = d theta / d s
  double curvature_slope_per_m2 = 0;    ///< d kappa / d s
  double up_m = 0;                      ///< planned altitude
  double up_slope = 0;                  ///< d up / d s
  double up_slope_rate_per_m = 0;       ///< d^2 up / d s^2
  double speed_m_s = 0;                 ///< planned speed of the leader, ds/dt
  double speed_slope_per_s = 0;         ///< d speed / d s
  double speed_slope_rate_per_m_s = 0;  ///< d^2 speed / d s^2
};

/// What all members of a formation can fly, and how far its slots reach from the leader.
/// Limits are already multiplied by the share of each that planning may use (0.6).
struct PathLimits {
  double min_speed_m_s = 30;  ///< of the slowest slot; largest of the members' least speeds, with a margin
  double max_speed_m_s = 90;  ///< of the fastest slot
  double max_acceleration_m_s2 = 1.2;
  double max_course_rate_rad_s = 0.12;
  double max_climb_rad = 0.21;
  double max_climb_rate_rad_s = 0.12;
  double most_left_m = 0;    ///< of the slots, >= 0
  double most_right_m = 0;   ///< of the slots, >= 0
  double foremost_m = 0;     ///< largest forward of the slots
  double hindmost_m = 0;     ///< least forward of the slots (-1000 for one slot 1000 m behind)
  double clearance_m = 300;  ///< that head and tail keep when they meet on a loop or circle
};
PathLimits LimitsOf(const std::vector<VehicleModel>& members, const std::vector<SlotOffset>& slots,
                    double share = 0.6);

/// The virtual leader's path: smooth, exact, endless both ways. A value; cheap to copy for short paths.
/// Before its first piece it extends straight back (level, at the first planned speed). Past its end an open
/// path goes on with its last curvature and altitude for good; a closed one repeats [loop_start, end).
class Path {
 public:
  /// Straight on from a pose for good.
  static Path Straight(const Eigen::Vector2d& start, double course_rad, double up_m, double speed_m_s);

  /// Throws std::invalid_argument: no piece or no knot, a length or speed that is not positive, anything not
  /// finite, knots that do not rise, a loop that does not start within the pieces. That the pieces meet is
  /// the maker's business.
  Path(double start_arc_m, std::vector<PathPiece> pieces, std::vector<ProfileKnot> profile,
       std::optional<double> loop_start_m);

  /// Allocates nothing; exact to well under 1 mm. On a closed path course goes on rising (falling) by
  /// lap_turn_rad() a lap.
  PathPoint At(double arc_m) const;
  PathPoint ShapeAt(double arc_m) const;  ///< At() without position and course, cheaper
  double SpeedAt(double arc_m) const;     ///< speed_m_s of At(), cheaper still

  double start_arc_m() const { return piece_arcs_m_.front(); }
  double end_arc_m() const { return piece_arcs_m_.back(); }  ///< of the last piece
  /// Length of the loop; 0: open.
  double lap_m() const { return loop_start_m_ ? end_arc_m() - *loop_start_m_ : 0; }
  double lap_turn_rad() const { return lap_turn_rad_; }  ///< change of course in one lap; 0: open
  bool closed() const { return loop_start_m_.has_value(); }
  std::optional<double> loop_start_m() const { return loop_start_m_; }
  const std::vector<PathPiece>& pieces() const { return pieces_; }
  const std::vector<ProfileKnot>& profile() const { return profile_; }

 private:
  struct Folded {
    double arc_m;  ///< on the first lap
    double laps;
  };
  Folded Fold(double arc_m) const;
  size_t PieceAt(double arc_m) const;  ///< of an arc length within the pieces

  std::vector<PathPiece> pieces_;
  std::vector<double> piece_arcs_m_;  ///< arc lengths of the starts of all pieces and of the end
  std::vector<ProfileKnot> profile_;
  std::optional<double> loop_start_m_;
  double lap_turn_rad_ = 0;
};

/// Why waypoints cannot be flown as they are, and at which of them, in words for an operator.
struct PathProblem {
  std::size_t waypoint = 0;  ///< index from 0
  bool on_leg = false;       ///< on the leg that begins at it
  std::string text;
};

/// A path, or why there is none, in words for an operator.
struct PathResult {
  std::optional<Path> path;
  std::string reason;  ///< of problems, the first one

  std::vector<PathProblem> problems = {};    ///< of PlanWaypoints: all that were found
  std::vector<double> waypoint_arcs_m = {};  ///< of PlanWaypoints: where on the path it goes by each waypoint
  double joins_at_m = 0;                     ///< of Join: from this arc length on it is the next path
  double shift_m = 0;  ///< of Join: what arc lengths there are more than on the next path
};

/// Through waypoints. A closed path needs 3 waypoints and is rounded at the first one, too: it begins behind
/// that turn. An open one needs 2 and ends in a loiter circle. Refused, with the number of each waypoint or
/// leg (from 1) and what would help: two identical waypoints in a row, a corner that turns back, legs too
/// short for the arcs, a radius, climb or change of speed that a slot cannot fly, a loop shorter than the
/// formation.
PathResult PlanWaypoints(const std::vector<Waypoint>& waypoints, bool closed, const PathLimits& limits);

/// From a pose along legs, then straight on. Refused like PlanWaypoints, with the leg's number.
PathResult PlanLegs(const Eigen::Vector2d& start, double course_rad, double up_m, double speed_m_s,
                    const std::vector<PathLeg>& legs, const PathLimits& limits);

/// From `arc_m` on `current` onto `next`, continuous in position, course, curvature, altitude and speed with
/// their slopes. What the slots are on stays: the path behind arc_m (at least `keep_behind_m` of it, and to
/// the hindmost slot) and on to the foremost slot, if that is ahead of the leader. Arc lengths go on
/// counting. Joins `next` at `next_arc_m` (its start, or where a held path is resumed) or the next point
/// ahead where it is straight. `next` is within the limits already, it is not checked again.
PathResult Join(const Path& current, double arc_m, const Path& next, double next_arc_m, double keep_behind_m,
                const PathLimits& limits);

/// From `arc_m` on `current` into the smallest circle that all can fly, for good; what the slots are on stays
/// as with Join. Turns the way that curvature already has, else left. Levels off from a climb; changes speed
/// where that of `current` has no circle of reasonable size. Refused only when no speed is within the limits
/// of all slots.
PathResult Loiter(const Path& current, double arc_m, double keep_behind_m, const PathLimits& limits);

/// Radius of that circle; none when no speed is within the limits of all slots.
std::optional<double> LoiterRadius(const PathLimits& limits, double speed_m_s);

/// Empty when the whole path is within the limits, else what is not and where; used when a formation is
/// edited in flight.
std::string Violation(const Path& path, const PathLimits& limits);

}  // namespace skein

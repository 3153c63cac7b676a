#include "core/path_limits.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace skein {
namespace {

/// Of the range of speeds, kept free at either end so that a slot can be caught up with.
constexpr double kSpeedMargin = 0.05;

/// A formation loiters where its outermost slots are at most this much slower and faster than the leader.
constexpr double kLoiterSpread = 0.2;

/// Of the acceleration limit, what a curvature ramp gets at least.
constexpr double kLeastRampShare = 0.1;

constexpr double kSampleStep_m = 5;
constexpr double kMostSamples = 50000;

/// A plan may be at its limit; rounding and sampling must not refuse it.
constexpr double kSlack = 1.005;

double Outermost(const PathLimits& limits) { return std::max(limits.most_left_m, limits.most_right_m); }

/// Largest of every `width` + 1 neighbours.
std::vector<double> WindowMax(const std::vector<double>& values, size_t width) {
  std::vector<double> largest;
  std::vector<size_t> candidates;  // falling values, from `first` on
  size_t first = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    while (candidates.size() > first && values[candidates.back()] <= values[i]) candidates.pop_back();
    candidates.push_back(i);
    if (candidates[first] + width < i) ++first;
    if (i >= width) largest.push_back(values[candidates[first]]);
  }
  return largest;
}

/// The leader over all places from which a slot is at each sample.
struct Samples {
  double step_m = 0;
  std::vector<PathPoint> points;
  std::vector<double> slowest;  ///< -speed
  std::vector<double> fastest;
  std::vector<double> acceleration;  ///< |dv/dt|
};

Samples Sample(const Path& path, const PathLimits& limits, double from_m, double to_m) {
  Samples samples;
  const double step = std::max(kSampleStep_m, (to_m - from_m) / kMostSamples);
  const size_t count = 1 + static_cast<size_t>(std::ceil((to_m - from_m) / step));
  samples.step_m = step;
  for (size_t i = 0; i < count; ++i) {
    samples.points.push_back(path.ShapeAt(std::min(to_m, from_m + static_cast<double>(i) * step)));
  }
  const size_t width = static_cast<size_t>(std::ceil((limits.foremost_m - limits.hindmost_m) / step));
  for (size_t i = 0; i < count + width; ++i) {
    const PathPoint leader = path.ShapeAt(from_m - limits.foremost_m + static_cast<double>(i) * step);
    samples.slowest.push_back(-leader.speed_m_s);
    samples.fastest.push_back(leader.speed_m_s);
    samples.acceleration.push_back(std::abs(leader.speed_m_s * leader.speed_slope_per_s));
  }
  samples.slowest = WindowMax(samples.slowest, width);
  samples.fastest = WindowMax(samples.fastest, width);
  samples.acceleration = WindowMax(samples.acceleration, width);
  return samples;
}

/// Acceleration of a slot `left_m` to the left along its flight path, without that of curvature ramps.
double OwnAcceleration(const PathPoint& point, double left_m, double speed_m_s, double acceleration_m_s2) {
  const double shrink = 1 - point.curvature_per_m * left_m;
  const double climb = std::atan(std::abs(point.up_slope) / std::max(shrink, 1e-3));
  return acceleration_m_s2 * shrink * std::cos(climb) +
         (speed_m_s * speed_m_s * std::abs(point.up_slope_rate_per_m) +
          acceleration_m_s2 * std::abs(point.up_slope)) *
             std::sin(climb);
}

std::string Words(const std::string& what, double value, double limit, const std::string& unit) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(unit == "m" ? 0 : unit == "m/s" ? 1 : 2);
  text << what << ' ' << value << ' ' << unit << ", the limit is " << limit << ' ' << unit;
  return text.str();
}

constexpr double kDegrees = 180 / M_PI;

/// What a slot `left_m` to the left cannot fly at a point, in words; empty when it can.
std::string SlotExcess(const PathPoint& point, double left_m, double slowest_m_s, double fastest_m_s,
                       double acceleration_m_s2, const PathLimits& limits) {
  const auto words = [&](const std::string& what, double value, double limit, const std::string& unit) {
    std::string name = "the slots";
    if (left_m != 0) {
      name = "the slot " + std::to_string(std::lround(std::abs(left_m))) + " m to the " +
             (left_m > 0 ? "left" : "right");
    }
    return Words(name + " would " + what, value, limit, unit);
  };
  const double shrink = 1 - point.curvature_per_m * left_m;
  if (slowest_m_s * shrink * kSlack < limits.min_speed_m_s) {
    return words("slow down to", slowest_m_s * shrink, limits.min_speed_m_s, "m/s");
  }
  if (fastest_m_s * shrink > limits.max_speed_m_s * kSlack) {
    return words("have to fly", fastest_m_s * shrink, limits.max_speed_m_s, "m/s");
  }
  const double course_rate = fastest_m_s * std::abs(point.curvature_per_m);
  if (course_rate > limits.max_course_rate_rad_s * kSlack) {
    return words("turn at", course_rate * kDegrees, limits.max_course_rate_rad_s * kDegrees, "deg/s");
  }
  const double slope = point.up_slope / shrink;
  const double climb = std::abs(std::atan(slope));
  if (climb > limits.max_climb_rad * kSlack) {
    return words("climb or descend at", climb * kDegrees, limits.max_climb_rad * kDegrees, "deg");
  }
  const double climb_rate =
      fastest_m_s / (shrink * (1 + slope * slope)) *
      std::abs(point.up_slope_rate_per_m + slope * point.curvature_slope_per_m2 * left_m);
  if (climb_rate > limits.max_climb_rate_rad_s * kSlack) {
    return words("change its climb angle at", climb_rate * kDegrees, limits.max_climb_rate_rad_s * kDegrees,
                 "deg/s");
  }
  const double acceleration = OwnAcceleration(point, left_m, fastest_m_s, acceleration_m_s2) +
                              fastest_m_s * fastest_m_s * std::abs(left_m * point.curvature_slope_per_m2);
  if (acceleration > limits.max_acceleration_m_s2 * kSlack) {
    return words("accelerate at", acceleration, limits.max_acceleration_m_s2, "m/s^2");
  }
  return {};
}

}  // namespace

PathLimits LimitsOf(const std::vector<VehicleModel>& members, const std::vector<SlotOffset>& slots,
                    double share) {
  const std::vector<VehicleModel> models = members.empty() ? std::vector<VehicleModel>(1) : members;
  PathLimits limits{0, 1e9, 1e9, 1e9, 1e9, 1e9};
  for (const VehicleModel& model : models) {
    const Envelope& envelope = model.envelope;
    const double margin = kSpeedMargin * (envelope.max_speed_m_s - envelope.min_speed_m_s);
    limits.min_speed_m_s = std::max(limits.min_speed_m_s, envelope.min_speed_m_s + margin);
    limits.max_speed_m_s = std::min(limits.max_speed_m_s, envelope.max_speed_m_s - margin);
    limits.max_acceleration_m_s2 =
        std::min(limits.max_acceleration_m_s2, share * envelope.max_acceleration_m_s2);
    limits.max_course_rate_rad_s =
        std::min(limits.max_course_rate_rad_s, share * envelope.max_course_rate_rad_s);
    limits.max_climb_rad = std::min(limits.max_climb_rad, share * envelope.max_climb_rad);
    limits.max_climb_rate_rad_s =
        std::min(limits.max_climb_rate_rad_s, share * envelope.max_climb_rate_rad_s);
  }
  if (slots.empty()) return limits;
  limits.foremost_m = limits.hindmost_m = slots.front().forward_m;
  for (const SlotOffset& slot : slots) {
    limits.most_left_m = std::max(limits.most_left_m, slot.left_m);
    limits.most_right_m = std::max(limits.most_right_m, -slot.left_m);
    limits.foremost_m = std::max(limits.foremost_m, slot.forward_m);
    limits.hindmost_m = std::min(limits.hindmost_m, slot.forward_m);
  }
  return limits;
}

std::optional<double> LeastRadius(const PathLimits& limits, const LeaderMotion& motion, double turn_rad) {
  const double inner = turn_rad > 0 ? limits.most_left_m : limits.most_right_m;
  const double outer = turn_rad > 0 ? limits.most_right_m : limits.most_left_m;
  const double slower = 1 - limits.min_speed_m_s / motion.min_speed_m_s;
  const double faster = limits.max_speed_m_s / motion.max_speed_m_s - 1;
  double radius = motion.max_speed_m_s / limits.max_course_rate_rad_s;
  if (slower < 0 || faster < 0) return std::nullopt;
  if (inner > 0) {
    if (slower == 0) return std::nullopt;
    radius = std::max(radius, inner / slower);
  }
  if (outer > 0) {
    if (faster == 0) return std::nullopt;
    radius = std::max(radius, outer / faster);
  }
  return radius;
}

std::optional<double> MostSlope(const PathLimits& limits, const LeaderMotion& motion,
                                double curvature_per_m) {
  const double speed = motion.max_speed_m_s;
  const double left_over = limits.max_acceleration_m_s2 - motion.acceleration_m_s2;
  const double by_time = curvature_per_m / (speed * kLeastRamp_s);
  if (Outermost(limits) == 0) return by_time;
  if (left_over < kLeastRampShare * limits.max_acceleration_m_s2) return std::nullopt;
  return std::min(by_time, left_over / (speed * speed * Outermost(limits)));
}

LeaderMotion MotionWhile(const Path& path, const PathLimits& limits, double from_m, double to_m) {
  const Samples samples = Sample(path, limits, from_m, to_m);
  LeaderMotion motion{1e9, 0, 0};
  for (size_t i = 0; i < samples.points.size(); ++i) {
    motion.min_speed_m_s = std::min(motion.min_speed_m_s, -samples.slowest[i]);
    motion.max_speed_m_s = std::max(motion.max_speed_m_s, samples.fastest[i]);
    for (const double left : {limits.most_left_m, -limits.most_right_m}) {
      motion.acceleration_m_s2 =
          std::max(motion.acceleration_m_s2,
                   OwnAcceleration(samples.points[i], left, samples.fastest[i], samples.acceleration[i]));
    }
  }
  return motion;
}

std::optional<Excess> FirstExcess(const Path& path, const PathLimits& limits, double from_m, double to_m) {
  const Samples samples = Sample(path, limits, from_m, to_m);
  for (size_t i = 0; i < samples.points.size(); ++i) {
    for (const double left : {limits.most_left_m, -limits.most_right_m}) {
      std::string what = SlotExcess(samples.points[i], left, -samples.slowest[i], samples.fastest[i],
                                    samples.acceleration[i], limits);
      if (!what.empty()) return Excess{samples.points[i].arc_m, std::move(what)};
    }
  }
  return std::nullopt;
}

double LoiterSpeed(const PathLimits& limits, double speed_m_s) {
  // With narrow formations the course rate sets the radius, and less of a spread will do.
  const double spread = std::min(kLoiterSpread, Outermost(limits) * limits.max_course_rate_rad_s / speed_m_s);
  const double slowest = limits.min_speed_m_s / (1 - spread);
  const double fastest = limits.max_speed_m_s / (1 + spread);
  // Where no speed has room on both sides, the one in the middle has the most.
  if (slowest > fastest) return std::sqrt(limits.min_speed_m_s * limits.max_speed_m_s);
  return std::clamp(speed_m_s, slowest, fastest);
}

double LeastLoop(const PathLimits& limits) {
  return limits.foremost_m - limits.hindmost_m + limits.clearance_m;
}

std::optional<double> LoiterRadius(const PathLimits& limits, double speed_m_s) {
  const double speed = LoiterSpeed(limits, speed_m_s);
  const LeaderMotion motion{speed, speed, 0};
  double radius = 0;
  for (const double side : {1, -1}) {
    const std::optional<double> least = LeastRadius(limits, motion, side);
    if (!least) return std::nullopt;
    radius = std::max(radius, *least);
  }
  // Head and tail, seen across the gap between them on the innermost slot's circle.
  const double length = limits.foremost_m - limits.hindmost_m;
  const auto meet = [&] {
    const double gap_rad = 2 * M_PI - length / radius;
    return gap_rad < M_PI &&
           (gap_rad <= 0 || 2 * (radius - Outermost(limits)) * std::sin(0.5 * gap_rad) < limits.clearance_m);
  };
  while (meet()) radius *= 1.01;
  return radius;
}

std::string Violation(const Path& path, const PathLimits& limits) {
  const double length = limits.foremost_m - limits.hindmost_m;
  if (path.closed() && path.lap_m() < LeastLoop(limits)) {
    return Words("the loop is shorter than the formation with its clearance: it is", path.lap_m(),
                 LeastLoop(limits), "m");
  }
  const double to = std::max(path.end_arc_m(), path.profile().back().arc_m);
  // Round again on a loop: what the leader does a lap later meets the slots that are still behind.
  const auto excess = FirstExcess(path, limits, path.start_arc_m(),
                                  to + (path.closed() ? std::min(length, path.lap_m()) : 0));
  if (!excess) return {};
  std::ostringstream text;
  text << excess->what << ' ' << std::lround(excess->arc_m - path.start_arc_m()) << " m along the path";
  return text.str();
}

}  // namespace skein

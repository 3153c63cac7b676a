#include "core/path_connect.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double kFullTurn_rad = 2 * M_PI;

/// A path that turns further than this soon crosses itself.
constexpr double kMostTightTurn_rad = 3.5;

constexpr int kScanSteps = 96;
constexpr int kBisections = 100;
constexpr double kClosed_m = 1e-6;

/// To 0 .. 2 pi.
double Positive(double angle_rad) {
  const double angle = std::fmod(angle_rad, kFullTurn_rad);
  return angle < 0 ? angle + kFullTurn_rad : angle;
}

/// One combination of turn sides. The angle of the first turn is the unknown; it fixes the heading of the
/// straight and so the second turn, and is right when the straight leads from the end of the one to the start
/// of the other.
class Word {
 public:
  Word(const Pose& from, const Pose& to, const TurnRate& rate, double first_side, double second_side)
      : from_(from), to_(to), rate_(rate), first_side_(first_side), second_side_(second_side) {}

  /// The shortest of this word. The second turn jumps by a full circle where it vanishes: the scan is cut
  /// there.
  std::optional<Connection> Shortest() {
    const double jump = Positive(first_side_ * (to_.course_rad - from_.course_rad));
    Scan(0, jump);
    Scan(jump, kFullTurn_rad);
    return shortest_;
  }

 private:
  struct Trial {
    Connection connection;
    double miss_m;  ///< how far to the left of the straight its end would have to be
  };

  void Scan(double from_rad, double to_rad) {
    const double middle = 0.5 * (from_rad + to_rad);
    const double heading = from_.course_rad + first_side_ * middle;
    second_at_middle_rad_ = Positive(second_side_ * (to_.course_rad - heading));
    middle_rad_ = middle;
    const int steps = 1 + static_cast<int>(kScanSteps * (to_rad - from_rad) / kFullTurn_rad);
    const double step = (to_rad - from_rad) / steps;
    Trial last = Try(from_rad);
    Keep(last);
    for (int i = 1; i <= steps; ++i) {
      const Trial next = Try(from_rad + i * step);
      if ((last.miss_m < 0) != (next.miss_m < 0))
        Keep(Bisect(from_rad + (i - 1) * step, from_rad + i * step, last.miss_m));
      last = next;
    }
    Keep(last);
  }

  Trial Bisect(double low_rad, double high_rad, double low_miss_m) const {
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (low_rad + high_rad);
      if (middle <= low_rad || middle >= high_rad) break;
      ((Try(middle).miss_m < 0) == (low_miss_m < 0) ? low_rad : high_rad) = middle;
    }
    return Try(low_rad);
  }

  Trial Try(double first_rad) const {
    const double second_rad = std::clamp(
        second_at_middle_rad_ - second_side_ * first_side_ * (first_rad - middle_rad_), 0.0, kFullTurn_rad);
    const Turn first = MakeTurn(first_side_ * first_rad, rate_.curvature_per_m, rate_.slope_per_m2);
    const Turn second = MakeTurn(second_side_ * second_rad, rate_.curvature_per_m, rate_.slope_per_m2);
    const double heading = from_.course_rad + first.turn_rad;
    const Eigen::Vector2d start =
        from_.position + Chord(first) * Direction(from_.course_rad + 0.5 * first.turn_rad);
    const Eigen::Vector2d end = to_.position - Chord(second) * Direction(heading + 0.5 * second.turn_rad);
    const Eigen::Vector2d way = end - start, along = Direction(heading);
    return {{first, way.dot(along), second}, along.x() * way.y() - along.y() * way.x()};
  }

  void Keep(Trial trial) {
    if (std::abs(trial.miss_m) > kClosed_m || trial.connection.straight_m < -kClosed_m) return;
    trial.connection.straight_m = std::max(0.0, trial.connection.straight_m);
    if (!shortest_ || trial.connection.length_m() < shortest_->length_m()) shortest_ = trial.connection;
  }

  Pose from_, to_;
  TurnRate rate_;
  double first_side_, second_side_;
  double middle_rad_ = 0, second_at_middle_rad_ = 0;
  std::optional<Connection> shortest_;
};

double Furthest(const Connection& connection) {
  return std::max(std::abs(connection.first.turn_rad), std::abs(connection.second.turn_rad));
}

}  // namespace

std::optional<Connection> Connect(const Pose& from, const Pose& to, const TurnRate& tight,
                                  const TurnRate& wide) {
  std::optional<Connection> shortest;
  const auto take = [&](const TurnRate& rate, double most_turn_rad) {
    for (const double first : {1, -1}) {
      for (const double second : {1, -1}) {
        const std::optional<Connection> found = Word(from, to, rate, first, second).Shortest();
        if (!found || Furthest(*found) > most_turn_rad) continue;
        if (!shortest || found->length_m() < shortest->length_m()) shortest = found;
      }
    }
  };
  take(tight, kMostTightTurn_rad);
  take(wide, 1e9);
  return shortest;
}

}  // namespace skein

#include "core/fleet_motion.h"

#include <algorithm>
#include <cmath>

#include "core/processors.h"

namespace skein {
namespace {

/// Series for the turn of one step are exact to the last bit or two up to here.
constexpr double kFarthestTurn_rad = 0.1;
/// Turned angles gather an error of rounding with every step; it is taken out when each block's turn comes.
constexpr std::uint64_t kStepsPerRefresh = 64;

[[gnu::always_inline]] inline double Clamp(double value, double low, double high) {
  const double raised = value < low ? low : value;
  return raised > high ? high : raised;
}

struct Angle {
  double cosine;
  double sine;
};

/// The angle turned by a small one: addition theorems, with the small one's cosine and sine by their series.
[[gnu::always_inline]] inline Angle Turn(Angle angle, double by_rad) {
  const double x = by_rad * by_rad;
  const double sine = by_rad * (1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72))));
  const double cosine = 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56)));
  return {angle.cosine * cosine - angle.sine * sine, angle.sine * cosine + angle.cosine * sine};
}

struct Velocity3 {
  double east_m_s;
  double north_m_s;
  double up_m_s;
};

[[gnu::always_inline]] inline Velocity3 VelocityOf(double speed_m_s, Angle course, Angle climb) {
  const double horizontal_m_s = speed_m_s * climb.cosine;
  return {horizontal_m_s * course.cosine, horizontal_m_s * course.sine, speed_m_s * climb.sine};
}

}  // namespace

void FleetMotion::Add(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model) {
  Check(model);
  const std::size_t first = size_ % kBlockSize;
  if (first == 0) blocks_.emplace_back();
  Block& block = blocks_.back();
  block.lanes = (first / kTogether + 1) * kTogether;
  for (std::size_t lane = first; lane < block.lanes; ++lane) {
    block.speed_per_s[lane] = model.gains.speed_per_s;
    block.course_per_s[lane] = model.gains.course_per_s;
    block.climb_per_s[lane] = model.gains.climb_per_s;
    block.min_speed_m_s[lane] = model.envelope.min_speed_m_s;
    block.max_speed_m_s[lane] = model.envelope.max_speed_m_s;
    block.max_acceleration_m_s2[lane] = model.envelope.max_acceleration_m_s2;
    block.max_course_rate_rad_s[lane] = model.envelope.max_course_rate_rad_s;
    block.max_climb_rad[lane] = model.envelope.max_climb_rad;
    block.max_climb_rate_rad_s[lane] = model.envelope.max_climb_rate_rad_s;
    block.speed_input_m_s[lane] = input.speed_m_s;
    block.course_input_rad[lane] = input.course_rad;
    block.climb_input_rad[lane] = input.climb_rad;
    block.SetState(lane, state);
  }
  ++size_;
}

VehicleState FleetMotion::State(std::size_t uav) const {
  return blocks_[uav / kBlockSize].State(uav % kBlockSize);
}

void FleetMotion::SetState(std::size_t uav, const VehicleState& state) {
  blocks_[uav / kBlockSize].SetState(uav % kBlockSize, state);
}

void FleetMotion::SetInput(std::size_t uav, const AutopilotInput& input) {
  Block& block = blocks_[uav / kBlockSize];
  block.speed_input_m_s[uav % kBlockSize] = input.speed_m_s;
  block.course_input_rad[uav % kBlockSize] = input.course_rad;
  block.climb_input_rad[uav % kBlockSize] = input.climb_rad;
}

void FleetMotion::Step(double step_s) {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    if (block.IsOrdinary(step_s)) {
      block.Advance(step_s);
      if ((steps_ + i) % kStepsPerRefresh == 0) block.RefreshAngles();
    } else {
      block.AdvanceOneByOne(step_s);
    }
  }
  ++steps_;
}

VehicleState FleetMotion::Block::State(std::size_t lane) const {
  return {east_m[lane], north_m[lane], up_m[lane], speed_m_s[lane], course_rad[lane], climb_rad[lane]};
}

void FleetMotion::Block::SetState(std::size_t lane, const VehicleState& state) {
  east_m[lane] = state.east_m;
  north_m[lane] = state.north_m;
  up_m[lane] = state.up_m;
  speed_m_s[lane] = state.speed_m_s;
  course_rad[lane] = state.course_rad;
  climb_rad[lane] = state.climb_rad;
  course_cos[lane] = std::cos(state.course_rad);
  course_sin[lane] = std::sin(state.course_rad);
  climb_cos[lane] = std::cos(state.climb_rad);
  climb_sin[lane] = std::sin(state.climb_rad);
}

AutopilotInput FleetMotion::Block::Input(std::size_t lane) const {
  return {speed_input_m_s[lane], course_input_rad[lane], climb_input_rad[lane]};
}

VehicleModel FleetMotion::Block::Model(std::size_t lane) const {
  VehicleModel model;
  model.gains = {speed_per_s[lane], course_per_s[lane], climb_per_s[lane]};
  model.envelope = {min_speed_m_s[lane],         max_speed_m_s[lane], max_acceleration_m_s2[lane],
                    max_course_rate_rad_s[lane], max_climb_rad[lane], max_climb_rate_rad_s[lane]};
  return model;
}

SKEIN_FOR_EACH_PROCESSOR
bool FleetMotion::Block::IsOrdinary(double step_s) const {
  // Counted, not broken off: that goes for several lanes at once.
  int extraordinary = 0;
  for (std::size_t i = 0; i < lanes; ++i) {
    const bool inside = speed_m_s[i] >= min_speed_m_s[i] && speed_m_s[i] <= max_speed_m_s[i] &&
                        std::abs(climb_rad[i]) <= max_climb_rad[i];
    const double fastest_rad_s = std::max(max_course_rate_rad_s[i], max_climb_rate_rad_s[i]);
    extraordinary += !(inside && fastest_rad_s * step_s <= kFarthestTurn_rad);
  }
  return extraordinary == 0;
}

SKEIN_FOR_EACH_PROCESSOR
void FleetMotion::Block::Advance(double step_s) {
  const double half_s = step_s / 2;
  const double sixth_s = step_s / 6;
  SKEIN_EACH_BY_ITSELF
  for (std::size_t i = 0; i < lanes; ++i) {
    const double start_speed = speed_m_s[i];
    const double start_course = course_rad[i];
    const double start_climb = climb_rad[i];
    const Angle course{course_cos[i], course_sin[i]};
    const Angle climb{climb_cos[i], climb_sin[i]};

    // Of the three loops, as in Step().
    const auto acceleration = [&](double speed) {
      return Clamp(speed_per_s[i] * (speed_input_m_s[i] - speed), -max_acceleration_m_s2[i],
                   max_acceleration_m_s2[i]);
    };
    const auto course_rate = [&](double angle) {
      return Clamp(course_per_s[i] * (course_input_rad[i] - angle), -max_course_rate_rad_s[i],
                   max_course_rate_rad_s[i]);
    };
    const auto climb_rate = [&](double angle) {
      return Clamp(climb_per_s[i] * (climb_input_rad[i] - angle), -max_climb_rate_rad_s[i],
                   max_climb_rate_rad_s[i]);
    };
    const auto velocity = [&](double speed, double turned, double angle) {
      const double kept_climb = Clamp(angle, -max_climb_rad[i], max_climb_rad[i]);
      return VelocityOf(Clamp(speed, min_speed_m_s[i], max_speed_m_s[i]), Turn(course, turned),
                        Turn(climb, kept_climb - start_climb));
    };

    const double a1 = acceleration(start_speed);
    const double c1 = course_rate(start_course);
    const double m1 = climb_rate(start_climb);
    const Velocity3 v1 = VelocityOf(start_speed, course, climb);

    const double a2 = acceleration(start_speed + half_s * a1);
    const double c2 = course_rate(start_course + half_s * c1);
    const double m2 = climb_rate(start_climb + half_s * m1);
    const Velocity3 v2 = velocity(start_speed + half_s * a1, half_s * c1, start_climb + half_s * m1);

    const double a3 = acceleration(start_speed + half_s * a2);
    const double c3 = course_rate(start_course + half_s * c2);
    const double m3 = climb_rate(start_climb + half_s * m2);
    const Velocity3 v3 = velocity(start_speed + half_s * a2, half_s * c2, start_climb + half_s * m2);

    const double a4 = acceleration(start_speed + step_s * a3);
    const double c4 = course_rate(start_course + step_s * c3);
    const double m4 = climb_rate(start_climb + step_s * m3);
    const Velocity3 v4 = velocity(start_speed + step_s * a3, step_s * c3, start_climb + step_s * m3);

    east_m[i] += sixth_s * (v1.east_m_s + 2 * v2.east_m_s + 2 * v3.east_m_s + v4.east_m_s);
    north_m[i] += sixth_s * (v1.north_m_s + 2 * v2.north_m_s + 2 * v3.north_m_s + v4.north_m_s);
    up_m[i] += sixth_s * (v1.up_m_s + 2 * v2.up_m_s + 2 * v3.up_m_s + v4.up_m_s);

    speed_m_s[i] =
        Clamp(start_speed + sixth_s * (a1 + 2 * a2 + 2 * a3 + a4), min_speed_m_s[i], max_speed_m_s[i]);
    const double turned = sixth_s * (c1 + 2 * c2 + 2 * c3 + c4);
    course_rad[i] = start_course + turned;
    const Angle end_course = Turn(course, turned);
    course_cos[i] = end_course.cosine;
    course_sin[i] = end_course.sine;
    const double end_climb =
        Clamp(start_climb + sixth_s * (m1 + 2 * m2 + 2 * m3 + m4), -max_climb_rad[i], max_climb_rad[i]);
    climb_rad[i] = end_climb;
    const Angle turned_climb = Turn(climb, end_climb - start_climb);
    climb_cos[i] = turned_climb.cosine;
    climb_sin[i] = turned_climb.sine;
  }
}

void FleetMotion::Block::AdvanceOneByOne(double step_s) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    SetState(lane, skein::Step(State(lane), Input(lane), Model(lane), step_s));
  }
}

void FleetMotion::Block::RefreshAngles() {
  for (std::size_t lane = 0; lane < lanes; ++lane) SetState(lane, State(lane));
}

}  // namespace skein

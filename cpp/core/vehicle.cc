#include "core/vehicle.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/frames.h"

namespace skein {
namespace {

constexpr double kGravity_m_s2 = 9.80665;

/// The speed or the climb loop of eq. (1): a first-order lag whose rate is limited and whose value stays in a
/// range.
struct Loop {
  double gain_per_s;
  double max_rate;
  double low;
  double high;

  double Rate(double value, double input) const {
    return std::clamp(gain_per_s * (input - value), -max_rate, max_rate);
  }
  /// Rate with which a value outside of the range comes back, 0 inside.
  double ReturnRate(double value) const { return value > high ? -max_rate : value < low ? max_rate : 0; }
  /// What the value is after a step from `start` that ended at `end`: a value outside stops at the limit on
  /// its way back.
  double Keep(double start, double end) const {
    if (start > high) return std::max(end, high);
    if (start < low) return std::min(end, low);
    return std::clamp(end, low, high);
  }
};

Loop SpeedLoop(const VehicleModel& model) {
  const Envelope& envelope = model.envelope;
  return {model.gains.speed_per_s, envelope.max_acceleration_m_s2, envelope.min_speed_m_s,
          envelope.max_speed_m_s};
}

Loop ClimbLoop(const VehicleModel& model) {
  const Envelope& envelope = model.envelope;
  return {model.gains.climb_per_s, envelope.max_climb_rate_rad_s, -envelope.max_climb_rad,
          envelope.max_climb_rad};
}

/// Rate of a loop now: none outwards at a limit, back at the limit rate from outside of it.
double RespondLoop(const Loop& loop, double value, double input) {
  if (value > loop.high || value < loop.low) return loop.ReturnRate(value);
  const double rate = loop.Rate(value, input);
  if (value == loop.high) return std::min(rate, 0.0);
  if (value == loop.low) return std::max(rate, 0.0);
  return rate;
}

double CourseRate(double course_rad, double input_rad, const VehicleModel& model) {
  const double limit = model.envelope.max_course_rate_rad_s;
  return std::clamp(model.gains.course_per_s * (input_rad - course_rad), -limit, limit);
}

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d ToVector(const VehicleState& state) {
  return (Vector6d() << state.east_m, state.north_m, state.up_m, state.speed_m_s, state.course_rad,
          state.climb_rad)
      .finished();
}

VehicleState ToState(const Vector6d& vector) {
  return {vector[0], vector[1], vector[2], vector[3], vector[4], vector[5]};
}

void CheckPositive(double value, const char* field) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(field) + " must be above 0");
  }
}

}  // namespace

void Check(const VehicleModel& model) {
  CheckPositive(model.gains.speed_per_s, "speed_per_s");
  CheckPositive(model.gains.course_per_s, "course_per_s");
  CheckPositive(model.gains.climb_per_s, "climb_per_s");
  const Envelope& envelope = model.envelope;
  if (!(envelope.min_speed_m_s >= 0)) throw std::invalid_argument("min_speed_m_s must not be negative");
  if (!(envelope.max_speed_m_s > envelope.min_speed_m_s) || !std::isfinite(envelope.max_speed_m_s)) {
    throw std::invalid_argument("max_speed_m_s must be above min_speed_m_s");
  }
  CheckPositive(envelope.max_acceleration_m_s2, "max_acceleration_m_s2");
  CheckPositive(envelope.max_course_rate_rad_s, "max_course_rate_rad_s");
  CheckPositive(envelope.max_climb_rate_rad_s, "max_climb_rate_rad_s");
  CheckPositive(envelope.max_climb_rad, "max_climb_rad");
  if (!(envelope.max_climb_rad < std::numbers::pi / 2)) {
    throw std::invalid_argument("max_climb_rad must be below pi/2");
  }
}

AutopilotRates UnlimitedResponse(const VehicleState& state, const AutopilotInput& input,
                                 const AutopilotGains& gains) {
  return {gains.speed_per_s * (input.speed_m_s - state.speed_m_s),
          gains.course_per_s * (input.course_rad - state.course_rad),
          gains.climb_per_s * (input.climb_rad - state.climb_rad)};
}

AutopilotRates Respond(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model) {
  return {RespondLoop(SpeedLoop(model), state.speed_m_s, input.speed_m_s),
          CourseRate(state.course_rad, input.course_rad, model),
          RespondLoop(ClimbLoop(model), state.climb_rad, input.climb_rad)};
}

VehicleState Step(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model,
                  double step_s) {
  const Loop speed = SpeedLoop(model);
  const Loop climb = ClimbLoop(model);
  // A loop that starts outside of its range returns at a constant rate throughout the step.
  const double speed_return = speed.ReturnRate(state.speed_m_s);
  const double climb_return = climb.ReturnRate(state.climb_rad);

  // The range is kept here for the position only, not in the loops' own rates: a rate that dropped to zero at
  // the limit between two stages would leave the value hanging just short of the limit.
  const auto rates = [&](const Vector6d& at) -> Vector6d {
    VehicleState flown = ToState(at);
    flown.speed_m_s = speed.Keep(state.speed_m_s, flown.speed_m_s);
    flown.climb_rad = climb.Keep(state.climb_rad, flown.climb_rad);
    Vector6d derivative;
    derivative << Velocity(flown), speed_return != 0 ? speed_return : speed.Rate(at[3], input.speed_m_s),
        CourseRate(at[4], input.course_rad, model),
        climb_return != 0 ? climb_return : climb.Rate(at[5], input.climb_rad);
    return derivative;
  };

  const Vector6d start = ToVector(state);
  const Vector6d k1 = rates(start);
  const Vector6d k2 = rates(start + step_s / 2 * k1);
  const Vector6d k3 = rates(start + step_s / 2 * k2);
  const Vector6d k4 = rates(start + step_s * k3);
  VehicleState end = ToState(start + step_s / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
  end.speed_m_s = speed.Keep(state.speed_m_s, end.speed_m_s);
  end.climb_rad = climb.Keep(state.climb_rad, end.climb_rad);
  return end;
}

double BankAngle(double speed_m_s, double climb_rad, double course_rate_rad_s) {
  return -std::atan(speed_m_s * std::cos(climb_rad) * course_rate_rad_s / kGravity_m_s2);
}

}  // namespace skein

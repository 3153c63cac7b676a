#include "core/skein_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/frames.h"

namespace skein {
namespace {

/// A speed towards something and its derivative by distance.
struct Approach {
  double speed_m_s = 0;
  double slope_per_s = 0;
};

/// min(k e, sqrt(2 a (e - a / (2 k^2)))), joined smoothly where the two meet (e = a / k^2), at most
/// `fastest`.
Approach ApproachSpeed(double error_m, double gain_per_s, double braking_m_s2, double fastest_m_s) {
  const double distance = std::abs(error_m);
  const double knee = braking_m_s2 / (gain_per_s * gain_per_s);
  double speed = gain_per_s * distance;
  double slope = gain_per_s;
  if (distance > knee) {
    speed = std::sqrt(2 * braking_m_s2 * (distance - 0.5 * knee));
    slope = braking_m_s2 / speed;
  }
  if (speed > fastest_m_s) {
    speed = fastest_m_s;
    slope = 0;
  }
  return {std::copysign(speed, error_m), slope};
}

/// The inverse of one line of eq. (1): the input that makes the autopilot answer with `rate`.
double Invert(double state, double rate, double gain_per_s) { return state + rate / gain_per_s; }

double Symmetric(double value, double limit) { return std::clamp(value, -limit, limit); }

LawOutput Command(const VehicleState& state, const VehicleModel& model, const AutopilotInput& wanted,
                  const AutopilotRates& unlimited) {
  const Envelope& envelope = model.envelope;
  LawOutput output;
  output.setpoint.speed_m_s = std::clamp(wanted.speed_m_s, envelope.min_speed_m_s, envelope.max_speed_m_s);
  output.setpoint.course_rad = wanted.course_rad;
  output.setpoint.climb_rad = Symmetric(wanted.climb_rad, envelope.max_climb_rad);
  output.rates.acceleration_m_s2 = Symmetric(unlimited.acceleration_m_s2, envelope.max_acceleration_m_s2);
  output.rates.course_rate_rad_s = Symmetric(unlimited.course_rate_rad_s, envelope.max_course_rate_rad_s);
  output.rates.climb_rate_rad_s = Symmetric(unlimited.climb_rate_rad_s, envelope.max_climb_rate_rad_s);
  output.input.speed_m_s = Invert(state.speed_m_s, output.rates.acceleration_m_s2, model.gains.speed_per_s);
  output.input.course_rad =
      Invert(state.course_rad, output.rates.course_rate_rad_s, model.gains.course_per_s);
  output.input.climb_rad = Invert(state.climb_rad, output.rates.climb_rate_rad_s, model.gains.climb_per_s);
  return output;
}

}  // namespace

SkeinLawParameters SkeinLawParametersFrom(const std::map<std::string, double>& values) {
  SkeinLawParameters parameters;
  struct Field {
    double SkeinLawParameters::*value;
    double least;
    double most;
  };
  // 1e-6 stands for "more than nothing".
  static const std::map<std::string, Field> kFields = {
      {"position_per_s", {&SkeinLawParameters::position_per_s, 1e-6, 2}},
      {"speed_per_s", {&SkeinLawParameters::speed_per_s, 1e-6, 5}},
      {"course_per_s", {&SkeinLawParameters::course_per_s, 1e-6, 5}},
      {"climb_per_s", {&SkeinLawParameters::climb_per_s, 1e-6, 5}},
      {"integral_per_s2", {&SkeinLawParameters::integral_per_s2, 0, 1}},
      {"integral_zone_m", {&SkeinLawParameters::integral_zone_m, 0, 1e4}},
      {"approach_share", {&SkeinLawParameters::approach_share, 1e-6, 1}},
      {"lateral_m_s2", {&SkeinLawParameters::lateral_m_s2, 1e-6, 20}},
      {"lateral_m_s", {&SkeinLawParameters::lateral_m_s, 1e-6, 200}},
      {"vertical_m_s2", {&SkeinLawParameters::vertical_m_s2, 1e-6, 20}},
      {"vertical_m_s", {&SkeinLawParameters::vertical_m_s, 1e-6, 100}},
      {"margin_m_s", {&SkeinLawParameters::margin_m_s, 0, 100}},
  };
  for (const auto& [name, value] : values) {
    const auto field = kFields.find(name);
    if (field == kFields.end()) throw std::invalid_argument(name + ": control \"skein\" has no such gain");
    if (!(value >= field->second.least && value <= field->second.most)) {
      throw std::invalid_argument(name + ": must be more than " + std::to_string(field->second.least) +
                                  " and at most " + std::to_string(field->second.most));
    }
    parameters.*(field->second.value) = value;
  }
  return parameters;
}

SkeinLaw::SkeinLaw(const SkeinLawParameters& parameters) : parameters_(parameters) {}

LawOutput SkeinLaw::Control(const SlotReference& slot, const VehicleState& state, const VehicleModel& model,
                            double step_s) {
  const SkeinLawParameters& p = parameters_;
  const Envelope& envelope = model.envelope;

  const Eigen::Vector3d error = SlotError(slot, Position(state));
  const Eigen::Vector3d velocity = Velocity(state);
  const Eigen::Vector2d velocity_slot = ToLeaderFrame(velocity.head<2>(), slot.course_rad);

  // How fast the errors change; the slot's frame turns.
  const double forward_rate = slot.speed_m_s - velocity_slot.x() + slot.course_rate_rad_s * error.y();
  const double left_rate = -velocity_slot.y() - slot.course_rate_rad_s * error.x();
  const double up_rate = slot.climb_m_s - velocity.z();

  // Approach velocity per axis, in what the envelope leaves beside the slot's own speed.
  const double fastest = std::max(1.0, envelope.max_speed_m_s - p.margin_m_s - slot.speed_m_s);
  const double slowest = std::max(1.0, slot.speed_m_s - envelope.min_speed_m_s - p.margin_m_s);
  const double braking = p.approach_share * envelope.max_acceleration_m_s2;
  const Approach forward =
      ApproachSpeed(error.x(), p.position_per_s, braking, error.x() > 0 ? fastest : slowest);
  const Approach left = ApproachSpeed(error.y(), p.position_per_s, p.lateral_m_s2, p.lateral_m_s);
  const Approach up = ApproachSpeed(error.z(), p.position_per_s, p.vertical_m_s2, p.vertical_m_s);

  // The slow integral works near the slot only, so that an approach from afar does not wind it up.
  if (error.cwiseAbs().maxCoeff() < p.integral_zone_m) {
    learnt_m_s_ += p.integral_per_s2 * step_s * error;
    learnt_m_s_ = learnt_m_s_.cwiseMax(-5).cwiseMin(5);
  }

  // Desired velocity in the slot's frame, and its rate.
  Eigen::Vector2d desired(slot.speed_m_s + forward.speed_m_s + learnt_m_s_.x(),
                          left.speed_m_s + learnt_m_s_.y());
  Eigen::Vector2d desired_rate(slot.acceleration_m_s2 + forward.slope_per_s * forward_rate,
                               left.slope_per_s * left_rate);
  const double climb = slot.climb_m_s + up.speed_m_s + learnt_m_s_.z();
  const double climb_rate = slot.climb_acceleration_m_s2 + up.slope_per_s * up_rate;

  // Forward and sideways together must not ask for more speed than there is.
  const double most = envelope.max_speed_m_s - p.margin_m_s;
  if (desired.norm() > most) {
    desired *= most / desired.norm();
    desired_rate.setZero();
  }
  const double level_speed = std::max(desired.norm(), 1.0);

  AutopilotInput wanted;
  AutopilotRates rates;
  wanted.speed_m_s = std::hypot(level_speed, climb);
  rates.acceleration_m_s2 = (desired.dot(desired_rate) + climb * climb_rate) / wanted.speed_m_s +
                            p.speed_per_s * (wanted.speed_m_s - state.speed_m_s);
  const double bearing = std::atan2(desired.y(), desired.x());
  wanted.course_rad = UnwrapNear(slot.course_rad + bearing, state.course_rad);
  rates.course_rate_rad_s =
      slot.course_rate_rad_s +
      (desired.x() * desired_rate.y() - desired.y() * desired_rate.x()) / (level_speed * level_speed) +
      p.course_per_s * (wanted.course_rad - state.course_rad);
  // The vertical speed is what counts, so the climb angle is taken at the speed that the UAV has.
  const double speed = std::max(state.speed_m_s, 1.0);
  const double steepest = 0.95 * envelope.max_climb_rad;
  const double sine = climb / speed;
  if (std::abs(sine) < std::sin(steepest)) {
    wanted.climb_rad = std::asin(sine);
    rates.climb_rate_rad_s = climb_rate / (speed * std::cos(wanted.climb_rad));
  } else {
    wanted.climb_rad = std::copysign(steepest, sine);
  }
  rates.climb_rate_rad_s += p.climb_per_s * (wanted.climb_rad - state.climb_rad);
  return Command(state, model, wanted, rates);
}

LawOutput HoldAltitude(const VehicleState& held, const VehicleState& state, const VehicleModel& model) {
  // Altitude through eq. (1)'s own lag k_mu: s^2 + k_mu s + k_mu k = 0 is critically damped for k = k_mu / 4.
  const double gain_per_s = 0.25 * model.gains.climb_per_s;
  const double sine = gain_per_s * (held.up_m - state.up_m) / std::max(state.speed_m_s, 1.0);
  const double steepest = 0.5 * model.envelope.max_climb_rad;
  LawOutput output;
  output.input.speed_m_s = held.speed_m_s;
  output.input.course_rad = UnwrapNear(held.course_rad, state.course_rad);
  output.input.climb_rad = std::asin(Symmetric(sine, std::sin(steepest)));
  output.setpoint = output.input;
  output.rates = Respond(state, output.input, model);
  return output;
}

}  // namespace skein

#pragma once

#include <string>

namespace skein {

/// State of a 3-DOF UAV, s_i of [1] without its index. [1] is the paper; see cpp/core/README.md.
struct VehicleState {
  double east_m = 0;      ///< x, local ENU.
  double north_m = 0;     ///< y, local ENU.
  double up_m = 0;        ///< z, local ENU.
  double speed_m_s = 0;   ///< v, along the velocity vector.
  double course_rad = 0;  ///< phi, counter-clockwise from east, unwrapped.
  double climb_rad = 0;   ///< mu, climb angle, up positive.
};

/// Inputs of the autopilot, eq. (1) of [1]: v_c, phi_c (unwrapped), mu_c.
struct AutopilotInput {
  double speed_m_s = 0;
  double course_rad = 0;
  double climb_rad = 0;
};

/// Factors of the autopilot, eq. (1) of [1]; all > 0.
struct AutopilotGains {
  double speed_per_s = 0.01;  ///< k_v
  double course_per_s = 0.1;  ///< k_phi
  double climb_per_s = 0.1;   ///< k_mu
};

/// What a UAV can do. The response is limited to it, never the input.
struct Envelope {
  double min_speed_m_s = 30;
  double max_speed_m_s = 90;
  double max_acceleration_m_s2 = 2;    ///< both signs
  double max_course_rate_rad_s = 0.2;  ///< both signs
  double max_climb_rad = 0.35;         ///< both signs
  double max_climb_rate_rad_s = 0.2;   ///< both signs
};

struct VehicleModel {
  std::string name = "default";
  AutopilotGains gains;
  Envelope envelope;
};

/// Rates of the three autopilot loops, v', phi', mu'.
struct AutopilotRates {
  double acceleration_m_s2 = 0;
  double course_rate_rad_s = 0;
  double climb_rate_rad_s = 0;
};

/// Throws std::invalid_argument naming the field when a gain or limit makes no sense.
void Check(const VehicleModel& model);

/// Eq. (1) of [1] with its sign put right, v' = k_v (v_c - v) and so on.
AutopilotRates UnlimitedResponse(const VehicleState& state, const AutopilotInput& input,
                                 const AutopilotGains& gains);

/// The same, limited to the envelope: what the UAV does.
AutopilotRates Respond(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model);

/// One step of eqs. (1) and (2) of [1] by the fourth-order Runge-Kutta method with the input held.
/// The envelope is kept: speed and climb angle never leave it (a start outside of it comes back at the limit
/// rate).
VehicleState Step(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model,
                  double step_s);

/// Bank angle of a coordinated turn [rad], left turn negative (right wing down positive), for display.
double BankAngle(double speed_m_s, double climb_rad, double course_rate_rad_s);

}  // namespace skein

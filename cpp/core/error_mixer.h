#pragma once

#include "core/formation.h"
#include "core/vehicle.h"

namespace skein {

/// Desired minus actual state in the leader's frame: the s_i^d - s_i^L of eq. (7) of [1], with the sign that
/// goes with eq. (1).
struct StateError {
  double forward_m = 0;
  double left_m = 0;
  double up_m = 0;
  double speed_m_s = 0;
  double course_rad = 0;  ///< -pi .. pi
  double climb_rad = 0;
};

/// Error of a UAV against its slot, which is rigid in the leader's frame; eq. (6) of [1] with its axes put
/// right.
StateError ErrorInLeaderFrame(const VehicleState& leader, const SlotOffset& slot, const VehicleState& uav);

/// Eqs. (5), (10) of [1]. Defaults: Table I and the +-50 m of section III.C.
struct MixerGains {
  double k_ex = 1.5;                 ///< [1/m] forward, >= 0 as all
  double k_ev = 10;                  ///< [s/m] speed
  double k_ey = 0.1;                 ///< [1/m] left
  double k_ephi = 10;                ///< [1/rad] course
  double k_ez = 0.04;                ///< [1/m] up
  double k_emu = 5;                  ///< [1/rad] climb angle
  double saturation_forward_m = 50;  ///< both signs, > 0
  double saturation_left_m = 50;     ///< both signs, > 0
  double saturation_up_m = 50;       ///< both signs, > 0
};
/// Throws std::invalid_argument naming the gain that makes no sense.
void Check(const MixerGains& gains);

/// e_x, e_y, e_z: what the three PID controllers get.
struct MixedError {
  double speed = 0;   ///< e_x, drives the speed input
  double course = 0;  ///< e_y, drives the course input
  double climb = 0;   ///< e_z, drives the climb input
};

/// Eqs. (5), (9) to (11) of [1]: positions saturated, then mixed with speed, course and climb.
MixedError Mix(const StateError& error, const MixerGains& gains);

}  // namespace skein

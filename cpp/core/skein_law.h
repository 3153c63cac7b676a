#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "core/slot_reference.h"
#include "core/vehicle.h"

namespace skein {

/// Gains of control "skein". Names in files and messages are those of the fields.
struct SkeinLawParameters {
  double position_per_s = 0.2;     ///< approach speed per metre of slot error, near the slot, > 0
  double speed_per_s = 0.7;        ///< of the speed loop around eq. (1), > 0
  double course_per_s = 0.7;       ///< of the course loop, > 0
  double climb_per_s = 0.7;        ///< of the climb-angle loop, > 0
  double integral_per_s2 = 0.004;  ///< takes out what a wrong model leaves, >= 0
  double integral_zone_m = 20;     ///< only this near the slot does it work, >= 0
  double approach_share = 0.6;     ///< share of the acceleration limit that an approach plans with, 0 .. 1
  double lateral_m_s2 = 2.5;       ///< an approach from the side brakes at this, > 0
  double lateral_m_s = 30;         ///< fastest approach from the side, > 0
  double vertical_m_s2 = 1.5;      ///< an approach from above or below brakes at this, > 0
  double vertical_m_s = 10;        ///< fastest approach from above or below, > 0
  double margin_m_s = 2;           ///< speed kept free at both ends of the envelope, >= 0
};

/// Sets parameters by name. Throws std::invalid_argument for an unknown name or a value out of range, naming
/// it.
SkeinLawParameters SkeinLawParametersFrom(const std::map<std::string, double>& values);

/// What a law wants of one UAV.
struct LawOutput {
  AutopilotInput input;     ///< for eq. (1); not clipped to the envelope
  AutopilotInput setpoint;  ///< what is wanted now, within the envelope (course unwrapped)
  AutopilotRates rates;     ///< the rates that are wanted, within the envelope
};

/// Control "skein" of one UAV: desired velocity = slot velocity + a bounded approach velocity per path axis,
/// min(k e, sqrt(2 a e), v_max) towards the slot; commands invert the autopilot of eq. (1) of [1]: wanted
/// rate (the reference's own plus k times what is missing), clipped to the envelope, divided by k_v and added
/// to the state.
class SkeinLaw {
 public:
  explicit SkeinLaw(const SkeinLawParameters& parameters = SkeinLawParameters());

  /// @param slot at the UAV's own time stamp. @param step_s since the last call, > 0.
  LawOutput Control(const SlotReference& slot, const VehicleState& state, const VehicleModel& model,
                    double step_s);

  const SkeinLawParameters& parameters() const { return parameters_; }

 private:
  SkeinLawParameters parameters_;
  Eigen::Vector3d learnt_m_s_{0, 0, 0};  ///< the integral: an approach velocity per axis
};

/// Holds course, speed and altitude of `held`. For UAVs that are in no formation, and for those whose link is
/// lost: it does not invert the autopilot, so a command made from an old state does no harm.
LawOutput HoldAltitude(const VehicleState& held, const VehicleState& state, const VehicleModel& model);

}  // namespace skein

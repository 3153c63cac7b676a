#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/error_mixer.h"
#include "core/formation.h"
#include "core/pid.h"
#include "core/vehicle.h"

namespace skein {

/// All numbers of the paper's law: Tables I and II of [1] and its saturation.
struct PaperParameters {
  MixerGains mixer;
  PidGains speed{3, 0.1, 1, 1};
  PidGains course{5, 1, 1, 1};
  PidGains climb{5, 0.1, 1, 1};
};

/// The paper's parameters with some replaced by name: "k_ex", "speed_p", "saturation_up_m", ... (all of them
/// in README.md). Throws std::invalid_argument that names a name that there is not, or a value that makes no
/// sense.
PaperParameters PaperParametersFrom(const std::map<std::string, double>& by_name);

/// The formation law of [1], eqs. (4) to (11), of one UAV.
///
/// The PID of e_x gives the speed input itself, v_c; those of e_y and e_z give the course and climb inputs
/// seen from the leader, so phi_c = phi_L + PID(e_y) and mu_c = mu_L + PID(e_z). This reading reproduces the
/// curves of Fig. 6; README.md says how near. Inputs are not clamped: only the UAV limits its response.
class PaperLaw {
 public:
  /// Throws std::invalid_argument when a parameter makes no sense.
  explicit PaperLaw(const PaperParameters& parameters = {});

  /// One control step.
  /// @param leader the virtual leader at the time of `uav`. @param slot the UAV's place, rigid in the
  /// leader's frame.
  /// @param model what the station believes the UAV to be; tells when its response is at a limit.
  /// @param dt_s since the last step, > 0.
  /// @return the autopilot's inputs; the course is unwrapped, within a turn of uav.course_rad where the law
  /// lets it.
  AutopilotInput Update(const VehicleState& leader, const SlotOffset& slot, const VehicleState& uav,
                        const VehicleModel& model, double dt_s);

  /// For a UAV that cannot be reached: holds the law until the next Update(), which goes on without a bump.
  void Freeze();

  /// As new, for a UAV that gets another task.
  void Reset();

 private:
  MixerGains mixer_;
  Pid speed_;
  Pid course_;
  Pid climb_;
  std::optional<AutopilotInput> input_;  ///< the last one, by which the UAV flies now
};

}  // namespace skein

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vehicle.h"

namespace skein {

/// Many UAVs, moved together: Step() for all of them, several in one instruction and without a sine or cosine
/// from the library in most steps. Who is outside of its envelope, or turns very far in one step, is moved by
/// Step() itself. The results differ from Step()'s by rounding alone, and are the same on every processor.
class FleetMotion {
 public:
  /// Adds a UAV behind the others. Throws std::invalid_argument when the model makes no sense.
  void Add(const VehicleState& state, const AutopilotInput& input, const VehicleModel& model);

  std::size_t size() const { return size_; }
  VehicleState State(std::size_t uav) const;
  void SetState(std::size_t uav, const VehicleState& state);
  void SetInput(std::size_t uav, const AutopilotInput& input);

  /// Eqs. (1) and (2) of [1] by the fourth-order Runge-Kutta method, inputs held. @param step_s > 0
  void Step(double step_s);

 private:
  static constexpr std::size_t kBlockSize = 64;
  static constexpr std::size_t kTogether = 8;  ///< doubles in the widest registers
  using Column = std::array<double, kBlockSize>;

  /// A structure of arrays that stays in the first-level cache while it is worked on.
  struct Block {
    std::size_t lanes = 0;  ///< in use; a multiple of kTogether, the rest being copies of the last UAV
    Column east_m, north_m, up_m, speed_m_s, course_rad, climb_rad;
    Column course_cos, course_sin, climb_cos, climb_sin;  ///< of the two angles
    Column speed_input_m_s, course_input_rad, climb_input_rad;
    Column speed_per_s, course_per_s, climb_per_s;
    Column min_speed_m_s, max_speed_m_s, max_acceleration_m_s2;
    Column max_course_rate_rad_s, max_climb_rad, max_climb_rate_rad_s;

    VehicleState State(std::size_t lane) const;
    void SetState(std::size_t lane, const VehicleState& state);
    AutopilotInput Input(std::size_t lane) const;
    VehicleModel Model(std::size_t lane) const;

    /// Whether all are inside of their envelopes and turn little enough for Advance().
    bool IsOrdinary(double step_s) const;
    void Advance(double step_s);
    void AdvanceOneByOne(double step_s);
    void RefreshAngles();
  };

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace skein

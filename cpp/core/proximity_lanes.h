#pragma once

#include <array>
#include <cstddef>

namespace skein {

/// Eight UAVs, or eight boxes of UAVs, looked at together. The numbers are those of MotionBetween(), Tau()
/// and of the bounds in proximity_tree.h to the last bit: the same operations in the same order.
inline constexpr std::size_t kLanes = 8;

struct alignas(64) Lanes : std::array<double, kLanes> {};

/// Thresholds of eq. (3) of [1].
struct TauLimits {
  double d_mod_m = 0;
  double min_closing_m_s = 0;
};

/// Who looks.
struct Looker {
  std::array<double, 3> position;
  std::array<double, 3> velocity;
  double group = 0;  ///< 1 or more: of a formation with limits of its own; 0: strangers to all
  TauLimits own;     ///< towards the same group
  TauLimits others;  ///< towards anybody else
  TauLimits widest;  ///< the larger of both, field by field
};

struct EightUavs {
  std::array<Lanes, 3> position;
  std::array<Lanes, 3> velocity;
  Lanes group;
};

struct EightBoxes {
  std::array<Lanes, 3> low;
  std::array<Lanes, 3> high;
  std::array<Lanes, 3> velocity_low;
  std::array<Lanes, 3> velocity_high;
  Lanes group;  ///< of all within; -1: of several
};

/// Distances, and Tau; infinite where nobody closes.
struct Looks {
  Lanes range_m;
  Lanes tau_s;
};

void LookAt(const EightUavs& uavs, const Looker& looker, Looks& looks);
/// No distance and no Tau to anybody in a box is less than what is found for it.
void LookAt(const EightBoxes& boxes, const Looker& looker, Looks& looks);

}  // namespace skein

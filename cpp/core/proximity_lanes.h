#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skein {

/// Eight UAVs, or eight boxes of UAVs, looked at together, to find out at little cost who can matter to whom.
/// Whoever can matter is always named; some that cannot are, too. So who is named is looked at once more,
/// exactly, with MotionBetween() and Tau().
inline constexpr std::size_t kLanes = 8;

struct alignas(64) Lanes : std::array<double, kLanes> {};
/// 1 where it is so, 0 where not.
struct alignas(64) Marks : std::array<std::int64_t, kLanes> {};

/// A lane that is not in use holds a position that is not a number: it matters to nobody, and nobody to it.
struct EightUavs {
  std::array<Lanes, 3> position;
  std::array<Lanes, 3> velocity;
  Lanes group;  ///< 1 or more: of a formation with limits of its own; 0: strangers to all
};

struct EightBoxes {
  std::array<Lanes, 3> low;
  std::array<Lanes, 3> high;
  std::array<Lanes, 3> velocity_low;
  std::array<Lanes, 3> velocity_high;
  Lanes group;  ///< of all within; kSeveralGroups
};
inline constexpr double kSeveralGroups = -1;

/// Who matters: whoever is no farther away, or closes and has no more Tau, than this. The squares spare a
/// root and a quotient for each look.
struct PairReach {
  double range_m2;        ///< squared
  double tau_s;           ///< of eq. (3) of [1], with the next two
  double d_mod_m2;        ///< squared
  double min_closing_m2;  ///< squared [m^2/s^2]
};
/// The same of eight.
struct Reach {
  Lanes range_m2;
  Lanes tau_s;
  Lanes d_mod_m2;
  Lanes min_closing_m2;

  PairReach Of(std::size_t lane) const {
    return {range_m2[lane], tau_s[lane], d_mod_m2[lane], min_closing_m2[lane]};
  }
  void Set(std::size_t lane, const PairReach& to) {
    range_m2[lane] = to.range_m2;
    tau_s[lane] = to.tau_s;
    d_mod_m2[lane] = to.d_mod_m2;
    min_closing_m2[lane] = to.min_closing_m2;
  }
};

struct EightLookers {
  const EightUavs* uavs;
  Reach own;     ///< towards the same group
  Reach others;  ///< towards anybody else
};

/// Marks the lookers to whom somebody in one of the boxes may matter. False: to none.
bool MayMatter(const EightLookers& lookers, const EightBoxes& boxes, std::size_t box, Marks& to);
/// Marks the UAVs that may matter to one of the lookers. False: none.
bool MayMatter(const EightLookers& lookers, std::size_t looker, const EightUavs& uavs, Marks& who);
/// Squared distances from one box to eight others.
void Gaps(const EightBoxes& from, std::size_t box, const EightBoxes& to, Lanes& square_m2);

}  // namespace skein

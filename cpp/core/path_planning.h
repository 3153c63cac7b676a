#pragma once

#include <string>
#include <vector>

#include "core/path.h"
#include "core/path_limits.h"
#include "core/path_pieces.h"

namespace skein {

/// A turn as asked for.
struct TurnRequest {
  double turn_rad = 0;  ///< left positive
  double radius_m = 0;  ///< 0: the smallest in comfort
  double ramp_s = 0;    ///< 0: what the limits ask for
};

/// A turn within the limits, or why there is none.
struct TurnResult {
  Turn turn;
  std::string reason;  ///< empty when there is one
};

/// Of the least radius, what a turn without a radius of its own flies where the legs leave room.
constexpr double kComfortRadius = 1.25;

/// `comfort` 1 gives a turn without radius of its own the comfortable one, 0 the least, in between what is in
/// between.
TurnResult PlanTurn(const TurnRequest& request, const LeaderMotion& motion, const PathLimits& limits,
                    double comfort = 1);

/// The least and greatest of both.
LeaderMotion Widened(const LeaderMotion& one, const LeaderMotion& other);

/// Whether `inner` asks for nothing that `outer` does not allow for.
bool Covers(const LeaderMotion& outer, const LeaderMotion& inner);

/// "1,340 m", rounded up.
std::string Metres(double length_m);

}  // namespace skein

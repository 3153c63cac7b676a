#pragma once

#include <optional>

#include "core/path_pieces.h"

namespace skein {

/// Turn, straight, turn.
struct Connection {
  Turn first;
  double straight_m = 0;
  Turn second;

  double length_m() const { return first.length_m() + straight_m + second.length_m(); }
};

/// The curvature of turns and its change per metre, both > 0.
struct TurnRate {
  double curvature_per_m = 0;
  double slope_per_m2 = 0;
};

/// The shortest turn-straight-turn between two poses, of all four combinations of left and right. Turns of
/// more than about half a circle are flown at `wide`, the others at `tight`. None is possible only in rare
/// places close by.
std::optional<Connection> Connect(const Pose& from, const Pose& to, const TurnRate& tight,
                                  const TurnRate& wide);

}  // namespace skein

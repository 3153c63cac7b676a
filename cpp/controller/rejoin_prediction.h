#pragma once

#include <vector>

#include "core/altitude_offset.h"
#include "core/leader.h"
#include "core/proximity.h"
#include "core/skein_law.h"

namespace skein::controller {

/// A member that is in place and comes down to `ramp`'s target.
struct DescendingMember {
  SlotOffset slot;
  AltitudeRamp ramp;
};

/// The UAV that comes back, as it is now.
struct RejoiningMember {
  SlotOffset slot;
  AltitudeRamp ramp;
  SkeinLaw law;
  VehicleState state;
  VehicleModel model;
};

/// Flies a rejoining UAV ahead with its own law, until it is in place or for three minutes, while the others
/// come to their ramps' targets. True when it comes into place and nobody enters its cylinder (a quarter
/// larger) on the way.
bool ClearsEveryCylinder(const Path& path, double leader_arc_m, RejoiningMember back,
                         std::vector<DescendingMember> others, const ProximityLimits& limits);

}  // namespace skein::controller

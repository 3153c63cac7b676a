#include "controller/rejoin_prediction.h"

#include <cmath>

#include "core/frames.h"

namespace skein::controller {

bool ClearsEveryCylinder(const Path& path, double leader_arc_m, RejoiningMember back,
                         std::vector<DescendingMember> others, const ProximityLimits& limits) {
  constexpr double kStep = 0.25;
  constexpr double kHorizon = 180;
  constexpr double kInPlace = 20;
  constexpr double kRoom = 1.25;
  for (double time = 0; time < kHorizon; time += kStep) {
    const SlotReference slot = SlotOnPath(path, leader_arc_m, back.slot, back.ramp.now());
    const Eigen::Vector3d position = Position(back.state);
    for (DescendingMember& other : others) {
      const SlotReference place = SlotOnPath(path, leader_arc_m, other.slot, other.ramp.now());
      const Eigen::Vector3d apart = place.position - position;
      if (apart.head<2>().norm() < kRoom * limits.radius_m && std::abs(apart.z()) < kRoom * limits.height_m) {
        return false;
      }
      other.ramp.Advance(kStep);
    }
    if (SlotError(slot, position).norm() < kInPlace) return true;
    const LawOutput wanted = back.law.Control(slot, back.state, back.model, kStep);
    back.state = Step(back.state, wanted.input, back.model, kStep);
    back.ramp.Advance(kStep);
    leader_arc_m += path.SpeedAt(leader_arc_m) * kStep;
  }
  return false;
}

}  // namespace skein::controller

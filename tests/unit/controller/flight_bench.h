#pragma once

#include <map>
#include <vector>

#include "controller/formation_flight.h"
#include "core/frames.h"

namespace skein::controller {

/// Flies one FormationFlight against simulated UAVs without a bus: perfect telemetry, links cut by hand. A
/// UAV whose link is cut flies on level at once, and the controller is told after the time that the monitor
/// takes.
class FlightBench {
 public:
  static constexpr bus::Utime kTick = 50'000;
  static constexpr double kStep = 0.05;
  static constexpr double kFoundAfter = 4.1;
  static constexpr double kFreshFor = 3.0;

  FlightBench(const config::FormationConfig& config, const Path& path, const Airspace& airspace = {})
      : flight(config, VirtualLeader(path, path.start_arc_m(), bus::ToSeconds(time_)), airspace) {
    for (const Slot& slot : config.slots) {
      const SlotReference place = SlotOnPath(path, path.start_arc_m(), slot.offset, {});
      Uav& uav = uavs[slot.vehicle_id];
      uav.state = {place.position.x(), place.position.y(), place.position.z(),
                   place.speed_m_s,    place.course_rad,   0};
      uav.input = {uav.state.speed_m_s, uav.state.course_rad, 0};
      VehicleView& view = fleet[slot.vehicle_id];
      view.id = slot.vehicle_id;
      view.callsign = "UAV" + std::to_string(slot.vehicle_id);
    }
  }

  struct Uav {
    VehicleState state;
    AutopilotInput input;
    VehicleModel model;
    bool cut = false;
    double changed_s = -1e9;  ///< when it was cut or restored
  };

  double time_s() const { return bus::ToSeconds(time_ - kStart); }

  void Cut(int id) { uavs.at(id).cut = true, uavs.at(id).changed_s = time_s(); }
  void Restore(int id) { uavs.at(id).cut = false, uavs.at(id).changed_s = time_s(); }

  /// One tick: telemetry, control, commands, motion.
  FlightStep Tick() {
    for (auto& [id, uav] : uavs) {
      VehicleView& view = fleet.at(id);
      view.fresh = !uav.cut;
      if (!uav.cut) view.state = uav.state, view.state_utime = time_;
      const double since = time_s() - uav.changed_s;
      if (uav.cut && since >= kFoundAfter) view.lost = true;
      if (!uav.cut && since >= kFreshFor) view.lost = false;
    }
    FlightStep step = flight.Step(fleet, time_);
    for (const FlightCommand& command : step.commands) {
      Uav& uav = uavs.at(command.vehicle_id);
      if (!uav.cut) uav.input = command.output.input;
    }
    for (auto& [id, uav] : uavs) {
      if (uav.cut && time_s() - uav.changed_s >= 1)
        uav.input = {uav.state.speed_m_s, uav.state.course_rad, 0};
      uav.state = skein::Step(uav.state, uav.input, uav.model, kStep);
    }
    time_ += kTick;
    return step;
  }

  void Fly(double seconds) {
    for (double until = time_s() + seconds - 1e-6; time_s() < until;) Tick();
  }

  /// Slot minus UAV, in the slot's frame, now.
  Eigen::Vector3d Error(int id) const {
    const VirtualLeader& leader = flight.leader();
    for (const Slot& slot : flight.config().slots) {
      if (slot.vehicle_id != id) continue;
      const SlotReference place = SlotOnPath(leader.path(), leader.ArcAt(bus::ToSeconds(time_)), slot.offset,
                                             flight.avoidance().offset(id));
      return SlotError(place, Position(uavs.at(id).state));
    }
    return {0, 0, 0};
  }

  /// How near any two are to being inside the cylinder: below 1 they are in it.
  double LeastSeparation() const {
    const ProximityLimits& limits = flight.config().proximity;
    double least = 1e9;
    for (auto a = uavs.begin(); a != uavs.end(); ++a) {
      for (auto b = std::next(a); b != uavs.end(); ++b) {
        const Eigen::Vector3d apart = Position(a->second.state) - Position(b->second.state);
        least = std::min(
            least, std::max(apart.head<2>().norm() / limits.radius_m, std::abs(apart.z()) / limits.height_m));
      }
    }
    return least;
  }

 private:
  static constexpr bus::Utime kStart = 1'577'836'800'000'000;
  bus::Utime time_ = kStart;

 public:
  std::map<int, Uav> uavs;
  FleetPicture fleet;
  FormationFlight flight;
};

}  // namespace skein::controller

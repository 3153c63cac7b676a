#pragma once

#include <map>
#include <optional>
#include <skein/formation_status_t.hpp>
#include <string>
#include <variant>
#include <vector>

#include "config/scenario.h"
#include "controller/avoidance.h"
#include "controller/fleet_picture.h"
#include "core/leader.h"
#include "core/paper_law.h"
#include "core/skein_law.h"

namespace skein::controller {

/// What one UAV is to do now.
struct FlightCommand {
  int vehicle_id = 0;
  LawOutput output;
};

/// What a control step gave.
struct FlightStep {
  std::vector<FlightCommand> commands;
  std::vector<FlightEvent> events;
};

/// The airspace that all formations share.
struct Airspace {
  double ceiling_m = 1e9;
  double floor_m = 0;
  ProximityLimits strangers = StrangerLimits();
};

/// A way from where a leader is along waypoints, or all that is against it.
struct PathPlan {
  std::optional<Path> path;
  std::vector<PathProblem> problems;  ///< empty exactly when there is a path
  double joins_at_m = 0;              ///< arc length where the way to the waypoints ends
  /// Where the path goes by each waypoint; of a closed path the first time after joins_at_m.
  std::vector<double> waypoint_arcs_m;
};

/// Flies one formation: its virtual leader, the law of each member, and avoidance when a link is lost. Knows
/// no bus.
class FormationFlight {
 public:
  /// @param config its slots, control, gains; leader and path in it are not looked at. Throws
  /// std::invalid_argument.
  /// @param leader where the virtual leader is, and on which path.
  FormationFlight(const config::FormationConfig& config, VirtualLeader leader, const Airspace& airspace);

  /// One control step, at the time of a FLEET_STATE tick (not before the last one).
  FlightStep Step(const FleetPicture& fleet, bus::Utime utime);

  /// The fleet's clock was set: what was is now at `utime`.
  void TakeClock(bus::Utime utime);

  /// Takes new slots, control, gains or limits in flight. @return why not, empty when taken.
  std::string Edit(const config::FormationConfig& config, const FleetPicture& fleet);
  /// What TakePath would fly: a path through waypoints, joined from where the leader is; no waypoints:
  /// straight on.
  PathPlan PlanPath(const std::vector<Waypoint>& waypoints, bool closed, const FleetPicture& fleet) const;
  /// Flies it. @return why not, empty when taken.
  std::string TakePath(const std::vector<Waypoint>& waypoints, bool closed, const FleetPicture& fleet);
  /// Loiters here. @return why not, empty when it does.
  std::string Hold(const FleetPicture& fleet);
  /// Goes back to the path that Hold left. @return why not, empty when it does.
  std::string Resume(const FleetPicture& fleet);

  const config::FormationConfig& config() const { return config_; }
  const VirtualLeader& leader() const { return leader_; }
  const std::vector<Waypoint>& waypoints() const { return waypoints_; }
  void SetWaypoints(std::vector<Waypoint> waypoints) { waypoints_ = std::move(waypoints); }
  const Avoidance& avoidance() const { return avoidance_; }
  /// Takes up avoidance and mode as an earlier run told them, at the time that they were told of.
  void GoOnFrom(const formation_status_t& status);
  std::int64_t path_revision() const { return path_revision_; }
  void SetPathRevision(std::int64_t revision) { path_revision_ = revision; }
  bool HasMember(int vehicle_id) const { return members_.contains(vehicle_id); }
  /// Where Hold left the path, for Resume.
  struct PathBeforeHold {
    Path path;
    double arc_m;
  };
  const std::optional<PathBeforeHold>& before_hold() const { return before_hold_; }
  void SetBeforeHold(PathBeforeHold before) { before_hold_ = std::move(before); }
  bool holding() const { return before_hold_.has_value(); }

  /// Leader, slots and mode after the last step, as one message (not yet in chunks).
  formation_status_t Status(std::int64_t tick) const;

 private:
  struct Member {
    SlotOffset slot;
    std::variant<SkeinLaw, PaperLaw> law;
    bus::Utime controlled_utime = 0;   ///< time stamp of the telemetry last answered
    bus::Utime predict_utime = 0;      ///< not before this is its rejoin flown ahead again
    std::optional<VehicleState> held;  ///< what it holds while its link is lost
    SlotReference planned;             ///< its slot at this step, while nobody avoids anything
    Eigen::Vector3d error{0, 0, 0};    ///< slot minus UAV, slot frame
    Eigen::Vector3d slot_position{0, 0, 0};
    bool flown = false;
  };
  Member MakeMember(const Slot& slot) const;
  PathLimits LimitsFor(const FleetPicture& fleet, const std::vector<Slot>& slots, double share = 0.6) const;
  MemberObservation Unheard(int id) const;
  MemberObservation Observe(int id, Member& member, const VehicleView& view);
  double ClimbRate(const FleetPicture& fleet) const;
  std::vector<Traffic> Strangers(const FleetPicture& fleet) const;
  AirspaceLimits Surroundings(const FleetPicture& fleet) const;
  bool ReadyToMerge(int id, Member& member, const VehicleView& view);
  LawOutput Fly(Member& member, const VehicleView& view, const AltitudeOffset& offset);
  LawOutput HoldLost(Member& member, const VehicleView& view) const;
  SlotReference PlaceOf(const SlotOffset& slot, const AltitudeOffset& offset) const;
  void Measure(int id, Member& member, const VehicleView* view);
  void UpdateMode(const FleetPicture& fleet);
  double KeepBehind() const;

  config::FormationConfig config_;
  VirtualLeader leader_;
  Airspace airspace_;
  std::vector<Waypoint> waypoints_;
  std::map<int, Member> members_;
  Avoidance avoidance_;
  std::optional<PathBeforeHold> before_hold_;
  std::int64_t path_revision_ = 1;
  bus::Utime utime_ = 0;
  PathPoint here_;  ///< of the leader at utime_
  std::int8_t mode_ = formation_status_t::MODE_WAITING;
  bus::Utime mode_utime_ = 0;
  bus::Utime mode_end_utime_ = 0;
  double climb_from_m_ = 0;  ///< offset of the body when its present change of altitude began
  double climb_to_m_ = 0;    ///< its target
  std::string mode_text_ = "waiting for telemetry";
};

}  // namespace skein::controller

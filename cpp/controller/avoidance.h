#pragma once

#include <map>
#include <string>
#include <vector>

#include "controller/altitude_choice.h"
#include "core/altitude_offset.h"

namespace skein::controller {

/// What a member of a formation is to its main body.
///   kFlying --(link lost)--> kLost --(link back)--> kRejoining --(close to its slot)--> kFlying
enum class Role { kFlying, kLost, kRejoining };

/// Something an operator must know; the node turns it into an EVENT.
struct FlightEvent {
  std::int8_t severity = 0;  ///< as in event_t
  std::string code;
  int vehicle_id = 0;
  std::string text;
};

/// What avoidance has to know of a member at one instant.
struct MemberObservation {
  int id = 0;
  std::string callsign;
  bool heard = true;  ///< false: no telemetry since the controller started; nothing below is known
  bool lost = false;
  double level_m = 0;           ///< its height over the altitude planned for its slot
  bool in_place = false;        ///< near its slot, seen from above
  bool ready_to_merge = false;  ///< close enough to its slot, or on a way that is clear of everybody
  Traffic track;
};

/// Altitudes in a formation of which a member's data link is lost: the rest leave its level, it rejoins at
/// its own level, and all come together again when it is back in place. An avoidance climb is an offset in
/// time, the same for all who fly it.
class Avoidance {
 public:
  /// Moves everything on by step_s. Members come and go with the observations.
  /// @return what happened, in words for an operator.
  std::vector<FlightEvent> Update(const std::vector<MemberObservation>& members,
                                  const std::vector<Traffic>& strangers, const AirspaceLimits& limits,
                                  double step_s);

  Role role(int id) const;
  /// Offset of a member's slot from its planned altitude.
  AltitudeOffset offset(int id) const;
  /// True while a member that rejoins still changes its level: it must not close in before that.
  bool changing_level(int id) const;
  /// Offset of the main body, and so of the virtual leader.
  const AltitudeRamp& body() const { return body_; }
  /// True while anybody is lost or rejoins, or the body is away from its planned altitude.
  bool active() const;
  /// True when there is reason to change the altitude and none is free.
  bool blocked() const { return blocked_; }

  /// Takes up an avoidance that another run of the controller had begun.
  void Restore(const AltitudeOffset& body, double target_m);

 private:
  struct Member {
    Role role = Role::kFlying;
    AltitudeRamp ramp;
    double level_m = 0;
  };

  Member NewMember(const MemberObservation& seen, const AirspaceLimits& limits) const;
  void UpdateRole(const MemberObservation& seen, Member& member, const AirspaceLimits& limits,
                  std::vector<FlightEvent>& events);
  bool WayToBodyIsFree(int id, double level_m) const;
  double RejoinLevel(int id, double level_m, const AirspaceLimits& limits) const;
  void ChooseBodyTarget(const std::vector<MemberObservation>& members, const std::vector<Traffic>& strangers,
                        const AirspaceLimits& limits, std::vector<FlightEvent>& events);

  std::map<int, Member> members_;
  AltitudeRamp body_;
  bool blocked_ = false;
};

}  // namespace skein::controller

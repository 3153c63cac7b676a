#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bridge/binary_frames.h"
#include "bridge/json_messages.h"
#include "bridge/live_frame.h"
#include "bus/bus.h"
#include "controller/controller_state.h"
#include "core/path.h"
#include "experiment/preview.h"
#include "recording/fleet_table.h"
#include "recording/history.h"

namespace skein::bridge {

/// What "hello" tells beside the time.
struct HelloInfo {
  std::string version;
  std::string lcm_url;
  std::string tile_url;  ///< "": none
  std::string tile_attribution;
  Json tiles = nullptr;       ///< the operator's own map (MapTiles::Description), null: none
  Json replay = nullptr;      ///< {kind, name} when this is no live flight (README.md)
  Json recordings = nullptr;  ///< {live_bus, only} when recordings are served, too
};

/// Hears everything on the bus, holds the last of each, and says what has changed as frames for the browsers
/// (README.md).
class BusMirror {
 public:
  using Sink = std::function<void(const LiveFrame&)>;

  BusMirror(bus::Bus& bus, HelloInfo hello, Sink sink);

  /// For a browser that has just come: hello and the last of each, in an order in which nothing refers to
  /// what comes later; "complete" ends it, so that it can be shown at once.
  std::vector<LiveFrame> Snapshot() const;

  /// Where everybody is, and what is known of everybody, at this moment.
  LiveFrame Motion() const;
  LiveFrame Status() const;

  /// The flight as it is now, to fly a change ahead from.
  experiment::FlightPicture Picture() const;

  /// GET /api/state, GET /api/vehicles and GET /api/health.
  Json State() const;
  Json Health() const;
  Json Vehicles() const;

  /// The flight so far, and when it began.
  const recording::HistorySamples& FlightSoFar() const { return history_.samples(); }
  bus::Utime start_utime() const { return roster_.start_utime; }

  static constexpr bus::Utime kSilentAfter = 3 * bus::kSecond;
  static constexpr std::size_t kMaxEvents = 200;
  /// Above so many UAVs MOTION goes out at 5 Hz instead of 10, and all formations' statuses together once a
  /// second instead of each as it comes; a status with another mode still goes out at once.
  static constexpr std::size_t kManyVehicles = 100;

 private:
  /// A message that is repeated, and when it last was.
  struct Repeated {
    Json shown;
    bus::Utime heard_at = 0;
  };
  /// What only the scenario tells, read when its name is heard in a roster.
  struct Airspace {
    double ceiling_m = 1e9;
    ProximityLimits strangers = StrangerLimits();
  };
  struct DrawnPath {
    path_t message;
    Json shown;
    double drawn_from_arc_m = 0;  ///< where the leader was then
    bool endless = false;
  };

  void Hear(const fleet_roster_t& roster);
  void Hear(const fleet_state_t& state);
  bool HasRoomFor(std::int32_t formation_id) const;
  void Hear(const formation_t& formation);
  void Hear(const formation_status_t& status);
  void Hear(const path_t& path);
  void Hear(const event_t& event);
  void Hear(const heartbeat_t& heartbeat);
  void Hear(const alarm_list_t& list);
  void Hear(const recording_status_t& status);

  void Draw(DrawnPath& path);
  void Look();
  /// Another flight begins: what was said of the one before counts no more; what happened stays.
  void StartAnew();
  void ForgetFormations();
  void RemoveFormation(std::int32_t id);
  void SendMotion();
  void SendAllStatuses();
  /// Once for all messages that are handled at this moment.
  void SendStatusSoon();

  bus::Utime Now() const { return bus_.executor().Now(); }
  bool many() const { return fleet_.rows().size() > kManyVehicles; }
  FrameTime Time() const;
  Json Statuses() const;
  Json Hello() const;
  Json Silent() const;
  /// Null when it was not heard of late.
  Json Recording() const;

  bus::Bus& bus_;
  HelloInfo hello_;
  Sink sink_;

  recording::FleetTable fleet_;
  recording::History history_;
  fleet_roster_t roster_{};
  Json roster_shown_;  ///< null: none yet
  Airspace airspace_;
  bus::Utime state_utime_ = 0;
  std::map<std::int32_t, Repeated> formations_;
  std::map<std::int32_t, controller::FormationState> flights_;  ///< the messages themselves, as they come
  std::map<std::int32_t, double> leader_arcs_m_;
  std::map<std::int32_t, DrawnPath> paths_;
  std::map<std::string, Repeated> heartbeats_;
  Json alarms_;  ///< null: none yet
  Repeated recording_;
  std::set<std::string> silent_;
  std::deque<Json> events_;
  bool motion_skipped_ = false;
  bool status_due_ = false;
};

}  // namespace skein::bridge

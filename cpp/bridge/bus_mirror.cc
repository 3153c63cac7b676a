#include "bridge/bus_mirror.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "bridge/fleet_json.h"
#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/only_one.h"
#include "config/scenario.h"
#include "controller/fleet_picture.h"
#include "core/path_line.h"

namespace skein::bridge {
namespace {

namespace channel = bus::channel;

constexpr bus::Utime kMotionPeriod = bus::kSecond / 10;
constexpr bus::Utime kStatusPeriod = bus::kSecond / 2;
constexpr bus::Utime kAllStatusesPeriod = bus::kSecond;
constexpr bus::Utime kLookPeriod = bus::kSecond / 4;
// The controller repeats a formation once a second.
constexpr bus::Utime kFormationGoneAfter = 3 * bus::kSecond;
constexpr std::size_t kMostNodes = 100;
constexpr std::size_t kMostFormations = 10'000;
constexpr const char* kController = "formation-controller";
// An endless line is drawn 20 km ahead; it is drawn anew halfway.
constexpr double kDrawAnewAfter_m = 10'000;

std::string Key(const char* type, std::int32_t id) { return std::string(type) + "/" + std::to_string(id); }

double Rounded(double metres) { return std::round(metres * 100) / 100; }

LiveFrame StatusesFrame(const Json& statuses) {
  return TextFrame(Dump({{"type", "statuses"}, {"statuses", statuses}}), "statuses");
}

}  // namespace

BusMirror::BusMirror(bus::Bus& bus, HelloInfo hello, Sink sink)
    : bus_(bus), hello_(std::move(hello)), sink_(std::move(sink)) {
  bus::SubscribeChunks<fleet_roster_t>(bus, channel::kFleetRoster, [this](const auto& roster, int missing) {
    if (missing == 0) Hear(roster);
  });
  bus::SubscribeChunks<fleet_state_t>(bus, channel::kFleetState,
                                      [this](const auto& state, int) { Hear(state); });
  bus::SubscribeChunks<formation_status_t>(bus, channel::kFormationStatus,
                                           [this](const auto& status, int missing) {
                                             if (missing == 0) Hear(status);
                                           });
  bus::SubscribeChunks<proximity_t>(bus, channel::kProximity, [this](const auto& proximity, int) {
    if (fleet_.Take(proximity)) SendStatusSoon();
  });
  bus::SubscribeChunks<link_status_t>(bus, channel::kLinkStatus, [this](const auto& links, int) {
    if (fleet_.Take(links)) SendStatusSoon();
  });
  bus::SubscribeChunks<alarm_list_t>(bus, channel::kAlarms, [this](const auto& list, int missing) {
    if (missing == 0) Hear(list);
  });
  bus.Subscribe<formation_t>(channel::kFormation, [this](const auto& formation) { Hear(formation); });
  bus.Subscribe<path_t>(channel::kPath, [this](const auto& path) { Hear(path); });
  bus.Subscribe<event_t>(channel::kEvent, [this](const auto& event) { Hear(event); });
  bus.Subscribe<heartbeat_t>(channel::kHeartbeat, [this](const auto& heartbeat) { Hear(heartbeat); });
  bus.Subscribe<recording_status_t>(channel::kRecording, [this](const auto& status) { Hear(status); });
  bus.executor().Every(
      kMotionPeriod, [this] { SendMotion(); }, bus::kBetweenTicks);
  bus.executor().Every(
      kStatusPeriod, [this] { SendStatusSoon(); }, bus::kBetweenTicks);
  bus.executor().Every(
      kAllStatusesPeriod, [this] { SendAllStatuses(); }, bus::kBetweenTicks);
  bus.executor().Every(kLookPeriod, [this] { Look(); });
}

void BusMirror::Hear(const fleet_roster_t& roster) {
  const bool same_session = !roster_shown_.is_null() && roster.session_id == roster_.session_id;
  if (same_session && roster.revision == roster_.revision) return;
  // The first one ends no flight: what was heard before it is of this one.
  if (!same_session && !roster_shown_.is_null()) StartAnew();
  if (roster.start_utime != roster_.start_utime) history_.Clear();
  if (!same_session || roster.scenario != roster_.scenario) {
    const auto scenario = config::ReadScenarioOfFleet(roster.scenario, {}).value_or(config::Scenario());
    airspace_ = {scenario.ceiling_m, scenario.strangers};
  }
  roster_ = roster;
  fleet_.Take(roster.vehicles);
  roster_shown_ = ToJson(roster);
  sink_(TextFrame(Dump(roster_shown_), "roster"));
  SendStatusSoon();
}

void BusMirror::StartAnew() {
  fleet_.StartAnew();
  while (!formations_.empty()) RemoveFormation(formations_.begin()->first);
}

void BusMirror::Hear(const fleet_state_t& state) {
  state_utime_ = state.utime;
  fleet_.Take(state, Now());
}

// Whoever can send can invent formations.
bool BusMirror::HasRoomFor(std::int32_t formation_id) const {
  return flights_.contains(formation_id) || flights_.size() < kMostFormations;
}

void BusMirror::Hear(const formation_t& formation) {
  if (!HasRoomFor(formation.formation_id)) return;
  flights_[formation.formation_id].formation = formation;
  Repeated& known = formations_[formation.formation_id];
  Json shown = ToJson(formation);
  // It is repeated with a new time each time.
  if (known.heard_at != 0) known.shown["utime"] = shown["utime"];
  const bool changed = known.shown != shown;
  known = {std::move(shown), Now()};
  if (changed) sink_(TextFrame(Dump(known.shown), Key("formation", formation.formation_id)));
}

void BusMirror::Hear(const formation_status_t& status) {
  const std::int32_t id = status.formation_id;
  if (!HasRoomFor(id)) return;
  formation_status_t& last = flights_[id].status;
  const bool same_mode =
      last.formation_id == id && last.mode == status.mode && last.mode_text == status.mode_text;
  last = status;
  fleet_.Take(id, status.slots);
  leader_arcs_m_[id] = status.leader_arc_m;
  if (!many() || !same_mode) sink_(TextFrame(Dump(ToJson(status)), Key("status", id)));
  const auto path = paths_.find(id);
  if (path != paths_.end() && path->second.endless &&
      std::abs(status.leader_arc_m - path->second.drawn_from_arc_m) > kDrawAnewAfter_m) {
    Draw(path->second);
  }
}

void BusMirror::Hear(const path_t& path) {
  if (!HasRoomFor(path.formation_id)) return;
  flights_[path.formation_id].path = path;
  const auto known = paths_.find(path.formation_id);
  if (known != paths_.end() && known->second.message.path_revision == path.path_revision) return;
  DrawnPath& drawn = paths_[path.formation_id];
  drawn.message = path;
  Draw(drawn);
}

void BusMirror::Draw(DrawnPath& drawn) {
  const path_t& message = drawn.message;
  drawn.shown = ToJson(message);
  const auto leader = leader_arcs_m_.find(message.formation_id);
  drawn.drawn_from_arc_m = leader == leader_arcs_m_.end() ? message.start_arc_m : leader->second;
  Json line = Json::array();
  try {
    const Path path = bus::ToPath(message);
    const DrawnStretch stretch = StretchToDraw(path, drawn.drawn_from_arc_m, message.waypoints.empty());
    drawn.endless = stretch.endless;
    for (const Eigen::Vector3d& point : SampleLine(path, stretch.from_arc_m, stretch.to_arc_m)) {
      line.push_back({Rounded(point.x()), Rounded(point.y()), Rounded(point.z())});
    }
  } catch (const std::exception& error) {
    spdlog::warn("the path of formation {} cannot be drawn: {}", message.formation_id, error.what());
  }
  drawn.shown["line"] = std::move(line);
  sink_(TextFrame(Dump(drawn.shown), Key("path", message.formation_id)));
}

void BusMirror::Hear(const event_t& event) {
  events_.push_back(ToJson(event));
  if (events_.size() > kMaxEvents) events_.pop_front();
  sink_(TextFrame(Dump(events_.back())));
}

void BusMirror::Hear(const heartbeat_t& heartbeat) {
  if (bus::IsStandby(heartbeat.heartbeat_node)) return;
  // Whoever can send HEARTBEAT can invent names: who is silent makes room.
  if (heartbeats_.size() >= kMostNodes && !heartbeats_.contains(heartbeat.heartbeat_node)) {
    std::erase_if(heartbeats_,
                  [&](const auto& known) { return Now() - known.second.heard_at >= kSilentAfter; });
    if (heartbeats_.size() >= kMostNodes) return;
  }
  Repeated& known = heartbeats_[heartbeat.heartbeat_node];
  known = {ToJson(heartbeat), Now()};
  sink_(TextFrame(Dump(known.shown), "heartbeat/" + heartbeat.heartbeat_node));
}

void BusMirror::Hear(const alarm_list_t& list) {
  Json shown = ToJson(list);
  // It is repeated with a new time each time.
  if (!alarms_.is_null()) alarms_["utime"] = shown["utime"];
  if (alarms_ == shown) return;
  alarms_ = std::move(shown);
  sink_(TextFrame(Dump(alarms_), "alarms"));
}

void BusMirror::Hear(const recording_status_t& status) {
  recording_ = {ToJson(status), Now()};
  sink_(TextFrame(Dump(recording_.shown), "recording"));
}

Json BusMirror::Recording() const {
  return Now() - recording_.heard_at < kSilentAfter ? recording_.shown : Json();
}

void BusMirror::Look() {
  std::set<std::string> silent;
  for (const auto& [node, heartbeat] : heartbeats_) {
    if (Now() - heartbeat.heard_at >= kSilentAfter) silent.insert(node);
  }
  if (silent != silent_) {
    silent_ = std::move(silent);
    sink_(TextFrame(Dump(Silent()), "bus"));
  }
  ForgetFormations();
  history_.Take(fleet_, Time().t_s, Now());
}

void BusMirror::ForgetFormations() {
  // A formation that a living controller repeats no longer is gone. While the controller is silent, all may
  // still be flown.
  const auto controller = heartbeats_.find(kController);
  if (controller == heartbeats_.end() || Now() - controller->second.heard_at > 2 * bus::kSecond) return;
  std::vector<std::int32_t> gone;
  for (const auto& [id, formation] : formations_) {
    if (Now() - formation.heard_at >= kFormationGoneAfter) gone.push_back(id);
  }
  for (const std::int32_t id : gone) RemoveFormation(id);
}

void BusMirror::RemoveFormation(std::int32_t id) {
  formations_.erase(id);
  flights_.erase(id);
  leader_arcs_m_.erase(id);
  paths_.erase(id);
  fleet_.RemoveFormation(id);
  sink_(TextFrame(Dump({{"type", "formation_removed"}, {"formation_id", id}}), Key("formation", id)));
}

void BusMirror::SendMotion() {
  motion_skipped_ = many() && !motion_skipped_;
  if (!motion_skipped_ && !fleet_.rows().empty()) sink_(Motion());
}

void BusMirror::SendAllStatuses() {
  if (many()) sink_(StatusesFrame(Statuses()));
}

void BusMirror::SendStatusSoon() {
  if (status_due_ || fleet_.rows().empty()) return;
  status_due_ = true;
  bus_.executor().At(Now(), [this] {
    status_due_ = false;
    sink_(Status());
  });
}

FrameTime BusMirror::Time() const {
  if (state_utime_ == 0) return {Now(), -1};
  const bool started = !roster_shown_.is_null() && state_utime_ >= roster_.start_utime;
  return {state_utime_, started ? bus::ToSeconds(state_utime_ - roster_.start_utime) : -1};
}

LiveFrame BusMirror::Motion() const { return BinaryFrame(EncodeMotion(fleet_, Time(), Now()), "motion"); }
LiveFrame BusMirror::Status() const { return BinaryFrame(EncodeStatus(fleet_, Time()), "fleet status"); }

Json BusMirror::Statuses() const {
  Json all = Json::array();
  for (const auto& [id, flight] : flights_) {
    if (flight.status.formation_id == id) all.push_back(ToJson(flight.status));
  }
  return all;
}

Json BusMirror::Hello() const {
  return {{"type", "hello"},
          {"version", hello_.version},
          {"lcm_url", hello_.lcm_url},
          {"utime", Now()},
          {"tile_url", hello_.tile_url.empty() ? Json() : Json(hello_.tile_url)},
          {"tile_attribution", hello_.tile_attribution},
          {"tiles", hello_.tiles},
          {"replay", hello_.replay},
          {"recordings", hello_.recordings}};
}

Json BusMirror::Silent() const { return {{"type", "bus"}, {"nodes_silent", silent_}}; }

std::vector<LiveFrame> BusMirror::Snapshot() const {
  std::vector<LiveFrame> frames{TextFrame(Dump(Hello())), TextFrame(Dump(Silent()), "bus")};
  if (!roster_shown_.is_null()) frames.push_back(TextFrame(Dump(roster_shown_), "roster"));
  for (const auto& [id, formation] : formations_) {
    frames.push_back(TextFrame(Dump(formation.shown), Key("formation", id)));
  }
  for (const auto& [id, path] : paths_) frames.push_back(TextFrame(Dump(path.shown), Key("path", id)));
  if (const Json statuses = Statuses(); !statuses.empty()) frames.push_back(StatusesFrame(statuses));
  for (const auto& [node, heartbeat] : heartbeats_) {
    frames.push_back(TextFrame(Dump(heartbeat.shown), "heartbeat/" + node));
  }
  if (!alarms_.is_null()) frames.push_back(TextFrame(Dump(alarms_), "alarms"));
  if (const Json recording = Recording(); !recording.is_null()) {
    frames.push_back(TextFrame(Dump(recording), "recording"));
  }
  for (const Json& event : events_) frames.push_back(TextFrame(Dump(event)));
  if (!fleet_.rows().empty()) {
    frames.push_back(Motion());
    frames.push_back(Status());
  }
  frames.push_back(TextFrame(R"({"type":"complete"})"));
  return frames;
}

experiment::FlightPicture BusMirror::Picture() const {
  experiment::FlightPicture picture;
  picture.utime = state_utime_;
  picture.ceiling_m = airspace_.ceiling_m;
  picture.strangers = airspace_.strangers;
  for (const auto& [id, row] : fleet_.rows()) {
    if (!row.info) continue;
    experiment::FlightPicture::Vehicle vehicle{*row.info, std::nullopt, false};
    if (row.state) {
      controller::VehicleView view;
      view.model = bus::ToVehicleModel(*row.info);
      view.state = bus::ToVehicleState(*row.state);
      view.state_utime = std::min(row.state->utime, state_utime_);
      vehicle.state = view.At(state_utime_);
    }
    const auto is_lost = [&](std::int8_t link) { return link == link_status_t::LINK_LOST; };
    if (row.link && vehicle.state && (is_lost(row.link->downlink) || is_lost(row.link->uplink))) {
      vehicle.lost = true;
      vehicle.state->climb_rad = 0;
      if (is_lost(row.link->downlink)) {
        vehicle.state->east_m = row.link->estimated_east_m;
        vehicle.state->north_m = row.link->estimated_north_m;
        vehicle.state->up_m = row.link->estimated_up_m;
      }
    }
    picture.vehicles.push_back(std::move(vehicle));
  }
  for (const auto& [id, flight] : flights_) {
    const bool whole = flight.formation.formation_id == id && flight.path.formation_id == id &&
                       flight.status.formation_id == id;
    if (!whole) continue;
    controller::FormationState& state = picture.formations.emplace_back(flight);
    // What Hold left is not on the bus, and only Resume asks for it.
    if (flight.formation.hold) state.path_before_hold = flight.path;
    state.arc_before_hold_m = flight.status.leader_arc_m;
  }
  return picture;
}

Json BusMirror::State() const {
  Json state = {{"hello", Hello()},
                {"nodes_silent", silent_},
                {"roster", roster_shown_},
                {"formations", Json::array()},
                {"paths", Json::array()},
                {"statuses", Statuses()},
                {"heartbeats", Json::array()},
                {"alarms", alarms_},
                {"recording", Recording()},
                {"events", Json(events_)}};
  for (const auto& [id, formation] : formations_) state["formations"].push_back(formation.shown);
  for (const auto& [id, path] : paths_) state["paths"].push_back(path.shown);
  for (const auto& [node, heartbeat] : heartbeats_) state["heartbeats"].push_back(heartbeat.shown);
  return state;
}

Json BusMirror::Health() const {
  Json nodes = Json::array();
  for (const auto& [node, heartbeat] : heartbeats_) {
    if (!silent_.contains(node)) nodes.push_back(node);
  }
  return {{"nodes", nodes}, {"nodes_silent", silent_}};
}

Json BusMirror::Vehicles() const {
  const FrameTime time = Time();
  return {{"utime", time.utime}, {"t_s", time.t_s}, {"vehicles", ToJson(fleet_, Now())}};
}

}  // namespace skein::bridge

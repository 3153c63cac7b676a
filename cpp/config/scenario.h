#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "core/formation.h"
#include "core/path.h"
#include "core/proximity.h"
#include "core/vehicle.h"

namespace skein::config {

/// A file that cannot be used. what() is "file: /path/in/the/file: reason".
class ConfigError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Origin {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above the WGS-84 ellipsoid
};

/// What a UAV does when its uplink is lost.
enum class UplinkLoss { kHoldLevelAfterOneSecond, kKeepLastCommand };

/// One direction of a data link.
struct LinkQuality {
  double delay_s = 0;
  double jitter_s = 0;  ///< added, uniform 0 .. jitter_s
  double loss = 0;      ///< probability 0 .. 1
};

struct VehicleConfig {
  int id = 0;
  std::string callsign;
  VehicleState start;
  VehicleModel model;                    ///< what the roster tells the station
  std::optional<AutopilotGains> actual;  ///< what it really flies with, when that differs (robustness trials)
  UplinkLoss uplink_loss = UplinkLoss::kHoldLevelAfterOneSecond;
  LinkQuality uplink;
  LinkQuality downlink;
  bool has_payload = true;
};

struct LeaderConfig {
  double east_m = 0;
  double north_m = 0;
  double up_m = 0;
  double speed_m_s = 50;
  double course_rad = 0;  ///< counter-clockwise from east (compass degrees in the file)
};

/// Either waypoints or legs from the leader's start.
struct PathConfig {
  bool closed = false;
  std::vector<Waypoint> waypoints;
  std::vector<PathLeg> legs;
};

struct FormationConfig {
  int id = 0;
  std::string name;
  std::string control = "skein";  ///< "skein" or "paper"
  Shape shape = Shape::kCustom;
  double spacing_m = 500;
  double lead_m = 1000;
  LeaderConfig leader;
  std::vector<Slot> slots;  ///< always filled in, from the shape when the file names one
  ProximityLimits proximity;
  std::map<std::string, double> gains;  ///< beside the preset of the control
  std::optional<PathConfig> path;
};

/// Something that happens at a time of the scenario.
struct CutLink {
  int vehicle_id = 0;
  bool uplink = true;
  bool downlink = true;
  bool frozen = false;          ///< repeats its last state instead of falling silent
  std::optional<double> for_s;  ///< until restored, when empty
};
struct RestoreLink {
  int vehicle_id = 0;
};
struct SetLink {
  int vehicle_id = 0;
  std::optional<LinkQuality> uplink;
  std::optional<LinkQuality> downlink;
};
struct TimelineEntry {
  double at_s = 0;
  std::variant<CutLink, RestoreLink, SetLink> action;
};

/// A number is drawn from it, both ends included.
struct Span {
  double least = 0;
  double most = 0;
};

/// Each is drawn within so much on either side of the scenario's own.
struct StartVariation {
  std::vector<int> vehicles;  ///< whose; empty: everybody's
  double east_m = 0;
  double north_m = 0;
  double up_m = 0;
  double speed_m_s = 0;
  double course_rad = 0;
};
struct TimelineVariation {
  double at_s = 0;   ///< one draw for all entries of a UAV
  double for_s = 0;  ///< a draw for each cut that ends by itself
};
/// Instead of the scenario's own; drawn for each UAV.
struct LinkVariation {
  std::optional<Span> delay_s;
  std::optional<Span> jitter_s;
  std::optional<Span> loss;
};

/// What differs from run to run of a campaign.
struct Variation {
  StartVariation start;
  TimelineVariation timeline;
  LinkVariation uplink;
  LinkVariation downlink;
  std::optional<Span> autopilot_scale;  ///< times what each UAV's gains would be
};

struct Scenario {
  std::string name;
  std::string description;  ///< for people; "" when there is none
  std::filesystem::path file;
  double duration_s = 300;  ///< of flight-experiment; a live scenario goes on
  Origin origin;
  double ceiling_m = 1e9;  ///< no avoidance climb above this; "ceiling_m" in the file
  ProximityLimits strangers = StrangerLimits();
  std::vector<FormationConfig> formations;
  std::vector<VehicleConfig> vehicles;
  std::vector<TimelineEntry> timeline;  ///< in order of time
  double timeline_repeat_s = 0;   ///< > 0: the timeline starts again every so often (live demonstrations)
  std::optional<Variation> vary;  ///< of campaigns; every other flight is the scenario as it is
};

/// Reads and checks a scenario. Throws ConfigError.
Scenario LoadScenario(const std::filesystem::path& file);

/// A path given by file name, or by the bare name of one that ships ("triangle", "triangle.json"): where it
/// is. Throws ConfigError naming the folders that were searched.
std::filesystem::path FindScenario(const std::string& name);

/// Where the scenario of a bare name is, never of a path: beside the file `own`, or where FindScenario looks.
/// Throws ConfigError.
std::filesystem::path FindNamedScenario(const std::string& name, const std::filesystem::path& own = {});

/// What a fleet flies, when all that is known of it is the scenario's "name" in the roster: the file `own`,
/// read again, when that is the one, else one beside it or where FindScenario looks. None when there is no
/// such.
std::optional<Scenario> ReadScenarioOfFleet(const std::string& name, const std::filesystem::path& own);

/// The bare name of the scenario that has this "name", of those that FindScenario finds; none when there is
/// no such. Quick: the files are not checked.
std::optional<std::string> BareNameOf(const std::string& name);

/// A scenario as a list of them shows it.
struct ScenarioEntry {
  std::string bare_name;  ///< what FindScenario takes
  std::string name;       ///< in the file, shown to people
  std::string description;
  std::size_t vehicles = 0;
  double duration_s = 0;
  std::string problem;  ///< why it cannot be flown, "" when it can; then the others are empty
};

/// All that FindScenario finds by a bare name, in order of it.
std::vector<ScenarioEntry> ListScenarios();

}  // namespace skein::config

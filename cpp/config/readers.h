#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "config/json_reader.h"
#include "config/scenario.h"

// The parts of a scenario file, a reader each. cpp/config/README.md is the reference of their keys.
namespace skein::config {

inline constexpr Range kIds{1, 1e6};
inline constexpr Range kHorizontalM{-200e3, 200e3};
inline constexpr Range kUpM{-1000, 20e3};
inline constexpr Range kSpeedMS{0.1, 400};
inline constexpr Range kCompassDeg{-360, 360};
inline constexpr Range kSpacingM{1, 100e3};
inline constexpr Range kSeconds{0, 1e6};

/// What the top of a file says for all UAVs and formations that do not say otherwise.
struct Defaults {
  std::string control = "skein";
  std::map<std::string, VehicleModel> models;
  LinkQuality uplink;
  LinkQuality downlink;
  UplinkLoss uplink_loss = UplinkLoss::kHoldLevelAfterOneSecond;
  double autopilot_scale = 1;
};

std::string ReadControl(const Value& value);
UplinkLoss ReadUplinkLoss(const Value& value);
LinkQuality ReadLinkQuality(const Value& value, const LinkQuality& otherwise);
ProximityLimits ReadProximity(const Value& value, const ProximityLimits& otherwise);
std::map<std::string, VehicleModel> ReadModels(const Value& value);
VehicleModel ReadModel(const Value& value, const std::map<std::string, VehicleModel>& models);

/// The keys "model", "actual_gains", "autopilot_scale", "link", "uplink_loss" and "payload".
VehicleConfig ReadEquipment(const Object& object, const Defaults& defaults);
VehicleConfig ReadVehicle(const Value& value, const Defaults& defaults);

LeaderConfig ReadLeader(const Value& value);
/// @param origin added to every waypoint
PathConfig ReadPath(const Value& value, const Eigen::Vector3d& origin = {0, 0, 0});
/// The keys "control", "spacing_m", "lead_m", "proximity" and "gains".
FormationConfig ReadFormationLaw(const Object& object, const Defaults& defaults);
FormationConfig ReadFormation(const Value& value, const Defaults& defaults);
Shape ReadShape(const Value& value);

struct GeneratedFleet {
  std::vector<VehicleConfig> vehicles;
  std::vector<FormationConfig> formations;
};
GeneratedFleet ReadFleet(const Value& value, const Defaults& defaults);

TimelineEntry ReadTimelineEntry(const Value& value);

/// @param scenario all else of the file; whatever can be drawn must be right in it
Variation ReadVariation(const Value& value, const Scenario& scenario);

}  // namespace skein::config

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config/readers.h"
#include "core/frames.h"
#include "core/paper_law.h"
#include "core/skein_law.h"

namespace skein::config {
namespace {

Waypoint ReadWaypoint(const Value& value, const Eigen::Vector3d& origin) {
  const Object object(value, {"east_m", "north_m", "up_m", "speed_m_s", "turn_radius_m"});
  return {.east_m = origin.x() + object.Number("east_m", kHorizontalM),
          .north_m = origin.y() + object.Number("north_m", kHorizontalM),
          .up_m = origin.z() + object.Number("up_m", kUpM),
          .speed_m_s = object.Number("speed_m_s", kSpeedMS),
          .turn_radius_m = object.Number("turn_radius_m", {0, 1e6}, 0)};
}

PathLeg ReadLeg(const Value& value) {
  const Object object(value, {"straight_m", "turn_deg", "radius_m", "ramp_s", "climb_m", "speed_m_s"});
  object.RefuseBoth("straight_m", "turn_deg");
  object.RefuseBoth("straight_m", "radius_m");
  object.RefuseBoth("straight_m", "ramp_s");
  PathLeg leg;
  if (object.Has("straight_m")) {
    leg.length_m = object.Number("straight_m", {1, 1e6});
  } else if (const auto turn = object.Find("turn_deg")) {
    // Compass sense in files, right positive; left positive inside.
    leg.turn_rad = -turn->Number({-3600, 3600}) * M_PI / 180;
    if (leg.turn_rad == 0) turn->Refuse("must not be 0; give a straight leg by straight_m");
    leg.turn_radius_m = object.Number("radius_m", {1, 1e6});
    leg.ramp_s = object.Number("ramp_s", {0, 600}, 0);
  } else {
    value.Refuse("needs straight_m, or turn_deg and radius_m");
  }
  leg.climb_m = object.Number("climb_m", {-20e3, 20e3}, 0);
  if (object.Has("speed_m_s")) leg.speed_m_s = object.Number("speed_m_s", kSpeedMS);
  return leg;
}

std::map<std::string, double> ReadGains(const Value& value, const std::string& control) {
  std::map<std::string, double> gains;
  for (const auto& [name, member] : value.Members()) {
    gains[name] = member.Number({-1e6, 1e6});
    try {
      if (control == "paper") {
        PaperParametersFrom({{name, gains[name]}});
      } else {
        SkeinLawParametersFrom({{name, gains[name]}});
      }
    } catch (const std::invalid_argument& error) {
      member.Refuse(error.what());
    }
  }
  return gains;
}

std::vector<Slot> ReadSlots(const Value& value) {
  std::vector<Slot> slots;
  for (const Value& item : value.Items()) {
    const Object object(item, {"vehicle", "forward_m", "left_m", "up_m"});
    slots.push_back({.vehicle_id = object.At("vehicle").Integer(kIds),
                     .offset = {.forward_m = object.Number("forward_m", kHorizontalM),
                                .left_m = object.Number("left_m", kHorizontalM),
                                .up_m = object.Number("up_m", {-20e3, 20e3}, 0)}});
  }
  if (slots.empty()) value.Refuse("needs at least one slot");
  return slots;
}

std::vector<Slot> ReadShapeMembers(const Value& value, const FormationConfig& formation) {
  const auto members = value.Items();
  if (members.empty()) value.Refuse("needs at least one UAV");
  const auto offsets =
      ShapeSlots(formation.shape, static_cast<int>(members.size()), formation.spacing_m, formation.lead_m);
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < members.size(); ++i) {
    slots.push_back({.vehicle_id = members[i].Integer(kIds), .offset = offsets[i]});
  }
  return slots;
}

LeaderConfig LeaderAtStartOf(const PathConfig& path) {
  const Waypoint& first = path.waypoints[0];
  const Waypoint& second = path.waypoints[1];
  return {.east_m = first.east_m,
          .north_m = first.north_m,
          .up_m = first.up_m,
          .speed_m_s = first.speed_m_s,
          .course_rad = std::atan2(second.north_m - first.north_m, second.east_m - first.east_m)};
}

}  // namespace

std::string ReadControl(const Value& value) {
  std::string name = value.Text();
  if (name != "skein" && name != "paper") value.Refuse(UnknownName("control", name, {"skein", "paper"}));
  return name;
}

Shape ReadShape(const Value& value) {
  const std::string name = value.Text();
  if (const auto shape = ShapeFromName(name)) return *shape;
  value.Refuse(UnknownName(
      "shape", name,
      {"triangle", "column", "line_abreast", "echelon_left", "echelon_right", "diamond", "vee", "custom"}));
}

ProximityLimits ReadProximity(const Value& value, const ProximityLimits& otherwise) {
  const Object object(
      value, {"radius_m", "height_m", "d_mod_m", "advisory_tau_s", "caution_tau_s", "min_closing_m_s"});
  constexpr Range kDistance{1, 20e3};
  ProximityLimits limits = otherwise;
  limits.radius_m = object.Number("radius_m", kDistance, otherwise.radius_m);
  limits.height_m = object.Number("height_m", kDistance, otherwise.height_m);
  // A wider cylinder alone takes D_mod along.
  limits.d_mod_m = object.Number("d_mod_m", kDistance, std::max(limits.radius_m, otherwise.d_mod_m));
  limits.advisory_tau_s = object.Number("advisory_tau_s", {0.1, 3600}, otherwise.advisory_tau_s);
  limits.caution_tau_s = object.Number("caution_tau_s", {0.1, 3600}, otherwise.caution_tau_s);
  limits.min_closing_m_s = object.Number("min_closing_m_s", {0.01, 100}, otherwise.min_closing_m_s);
  if (limits.d_mod_m < limits.radius_m) {
    object.At("d_mod_m").Refuse("must be at least radius_m, or the levels would come in the wrong order");
  }
  if (limits.caution_tau_s >= limits.advisory_tau_s)
    value.Refuse("caution_tau_s must be less than advisory_tau_s");
  return limits;
}

LeaderConfig ReadLeader(const Value& value) {
  const Object object(value, {"east_m", "north_m", "up_m", "speed_m_s", "course_deg"});
  return {.east_m = object.Number("east_m", kHorizontalM),
          .north_m = object.Number("north_m", kHorizontalM),
          .up_m = object.Number("up_m", kUpM),
          .speed_m_s = object.Number("speed_m_s", kSpeedMS),
          .course_rad = CourseFromCompass(object.Number("course_deg", kCompassDeg))};
}

PathConfig ReadPath(const Value& value, const Eigen::Vector3d& origin) {
  const Object object(value, {"closed", "waypoints", "legs"});
  object.RefuseBoth("waypoints", "legs");
  object.RefuseBoth("legs", "closed");
  PathConfig path;
  path.closed = object.Boolean("closed", false);
  for (const Value& leg : object.Items("legs")) path.legs.push_back(ReadLeg(leg));
  for (const Value& point : object.Items("waypoints")) path.waypoints.push_back(ReadWaypoint(point, origin));
  if (path.legs.empty()) {
    const std::size_t least = path.closed ? 3 : 2;
    if (path.waypoints.size() < least) {
      value.Refuse("needs legs, or at least " + std::to_string(least) + " waypoints");
    }
  }
  return path;
}

FormationConfig ReadFormationLaw(const Object& object, const Defaults& defaults) {
  FormationConfig formation;
  formation.control = defaults.control;
  if (const auto control = object.Find("control")) formation.control = ReadControl(*control);
  formation.spacing_m = object.Number("spacing_m", kSpacingM, formation.spacing_m);
  formation.lead_m = object.Number("lead_m", {0, 100e3}, formation.lead_m);
  if (const auto proximity = object.Find("proximity")) {
    formation.proximity = ReadProximity(*proximity, ProximityLimits{});
  }
  if (const auto gains = object.Find("gains")) formation.gains = ReadGains(*gains, formation.control);
  return formation;
}

FormationConfig ReadFormation(const Value& value, const Defaults& defaults) {
  const Object object(value, {"id", "name", "control", "shape", "spacing_m", "lead_m", "leader", "slots",
                              "vehicles", "proximity", "gains", "path"});
  FormationConfig formation = ReadFormationLaw(object, defaults);
  formation.id = object.At("id").Integer(kIds);
  formation.name = object.Text("name", "Formation " + std::to_string(formation.id));
  formation.shape =
      object.Has("slots") && !object.Has("shape") ? Shape::kCustom : ReadShape(object.At("shape"));
  if (formation.shape == Shape::kCustom) {
    for (const std::string_view key : {"vehicles", "spacing_m", "lead_m"}) {
      if (const auto member = object.Find(key))
        member->Refuse("does not go with the shape \"custom\"; give slots");
    }
    formation.slots = ReadSlots(object.At("slots"));
  } else {
    if (const auto slots = object.Find("slots")) {
      slots->Refuse("go with the shape \"custom\" only; give vehicles and spacing_m");
    }
    formation.slots = ReadShapeMembers(object.At("vehicles"), formation);
  }
  if (const auto path = object.Find("path")) formation.path = ReadPath(*path);
  if (formation.path && !formation.path->waypoints.empty() && !object.Has("leader")) {
    formation.leader = LeaderAtStartOf(*formation.path);
  } else {
    formation.leader = ReadLeader(object.At("leader"));
  }
  return formation;
}

}  // namespace skein::config

#include <random>

#include "config/readers.h"
#include "core/frames.h"

namespace skein::config {
namespace {

// Uniform -1 .. 1 and the same on every library, which std::uniform_real_distribution is not.
double Symmetric(std::mt19937& random) { return static_cast<double>(random()) / 2147483647.5 - 1; }

Eigen::Vector3d PlaceInGrid(int index, int columns, const Eigen::Vector3d& step) {
  const int column = index % columns;
  const int row = index / columns;
  return {step.x() * column, step.y() * row, step.z() * index};
}

LeaderConfig Moved(LeaderConfig leader, const Eigen::Vector3d& by) {
  leader.east_m += by.x();
  leader.north_m += by.y();
  leader.up_m += by.z();
  return leader;
}

VehicleState StartAt(const LeaderConfig& leader, const SlotOffset& slot) {
  const Eigen::Vector2d place = FromLeaderFrame({slot.forward_m, slot.left_m}, leader.course_rad);
  return {.east_m = leader.east_m + place.x(),
          .north_m = leader.north_m + place.y(),
          .up_m = leader.up_m + slot.up_m,
          .speed_m_s = leader.speed_m_s,
          .course_rad = leader.course_rad,
          .climb_rad = 0};
}

}  // namespace

GeneratedFleet ReadFleet(const Value& value, const Defaults& defaults) {
  const Object object(value, {"count",        "formations",      "first_id",     "first_formation_id",
                              "shape",        "spacing_m",       "lead_m",       "control",
                              "proximity",    "gains",           "leader",       "path",
                              "columns",      "east_step_m",     "north_step_m", "up_step_m",
                              "scatter_m",    "scatter_up_m",    "seed",         "model",
                              "actual_gains", "autopilot_scale", "link",         "uplink_loss",
                              "payload"});
  const auto whole = [&](std::string_view key, Range range, int otherwise) {
    const auto member = object.Find(key);
    return member ? member->Integer(range) : otherwise;
  };
  const int count = object.At("count").Integer({1, 10000});
  const int groups = object.At("formations").Integer({0, static_cast<double>(count)});
  const int first_id = whole("first_id", kIds, 1);
  const int first_formation_id = whole("first_formation_id", kIds, 1);
  const int columns = whole("columns", {1, 10000}, 1);
  const Eigen::Vector3d step{object.Number("east_step_m", kHorizontalM, 0),
                             object.Number("north_step_m", kHorizontalM, 0),
                             object.Number("up_step_m", {-20e3, 20e3}, 0)};
  const double scatter_m = object.Number("scatter_m", {0, 10e3}, 0);
  const double scatter_up_m = object.Number("scatter_up_m", {0, 1e3}, 0);
  std::mt19937 random(static_cast<std::uint32_t>(whole("seed", {0, 1e9}, 1)));
  const VehicleConfig equipment = ReadEquipment(object, defaults);
  const LeaderConfig first_leader = ReadLeader(object.At("leader"));

  GeneratedFleet fleet;
  const auto add_vehicle = [&](const LeaderConfig& leader, const SlotOffset& slot) {
    VehicleConfig vehicle = equipment;
    vehicle.id = first_id + static_cast<int>(fleet.vehicles.size());
    vehicle.callsign = "UAV" + std::to_string(vehicle.id);
    vehicle.start = StartAt(leader, slot);
    vehicle.start.east_m += scatter_m * Symmetric(random);
    vehicle.start.north_m += scatter_m * Symmetric(random);
    vehicle.start.up_m += scatter_up_m * Symmetric(random);
    fleet.vehicles.push_back(vehicle);
    return vehicle.id;
  };

  if (groups == 0) {
    for (const std::string_view key :
         {"shape", "spacing_m", "lead_m", "control", "proximity", "gains", "path"}) {
      if (const auto member = object.Find(key)) member->Refuse("needs at least one formation");
    }
    for (int i = 0; i < count; ++i)
      add_vehicle(Moved(first_leader, PlaceInGrid(i, columns, step)), SlotOffset{});
    return fleet;
  }
  FormationConfig pattern = ReadFormationLaw(object, defaults);
  pattern.shape = ReadShape(object.At("shape"));
  if (pattern.shape == Shape::kCustom) object.At("shape").Refuse("must be a shape that can be generated");
  for (int group = 0; group < groups; ++group) {
    FormationConfig formation = pattern;
    const Eigen::Vector3d place = PlaceInGrid(group, columns, step);
    const int members = count / groups + (group < count % groups ? 1 : 0);
    formation.id = first_formation_id + group;
    formation.name = "Formation " + std::to_string(formation.id);
    formation.leader = Moved(first_leader, place);
    if (const auto path = object.Find("path")) formation.path = ReadPath(*path, place);
    for (const SlotOffset& slot :
         ShapeSlots(formation.shape, members, formation.spacing_m, formation.lead_m)) {
      formation.slots.push_back({.vehicle_id = add_vehicle(formation.leader, slot), .offset = slot});
    }
    fleet.formations.push_back(std::move(formation));
  }
  return fleet;
}

}  // namespace skein::config

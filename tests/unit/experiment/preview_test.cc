#include "experiment/preview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <skein/formation_command_t.hpp>

#include "bus/conversions.h"
#include "captured_flight.h"
#include "core/frames.h"

namespace skein::experiment {
namespace {

/// UAV2 and UAV3 of the triangle in one another's slots.
formation_t Swapped(formation_t formation) {
  std::swap(formation.slots[1].vehicle_id, formation.slots[2].vehicle_id);
  return formation;
}

const Track& TrackOf(const Preview& preview, int id) {
  return *std::find_if(preview.tracks.begin(), preview.tracks.end(),
                       [id](const Track& track) { return track.vehicle_id == id; });
}

path_command_t PathCommand(const std::vector<Waypoint>& waypoints, bool closed = false) {
  path_command_t command{};
  command.formation_id = 1;
  command.closed = closed;
  bus::SetWaypoints(command, waypoints);
  return command;
}

TEST(PreviewFormation, ComesAsNearAsTheSameEditThenDoes) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  // Wider, and two change places above one another.
  formation_t formation = Swapped(flight.flights.at(1).formation);
  formation.slots[1].left_m = 350;
  formation.slots[1].up_m = 70;
  formation.slots[2].left_m = -350;
  const Preview preview = PreviewFormation(flight.Picture(), formation, {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  EXPECT_TRUE(preview.complete);
  ASSERT_TRUE(preview.settle_s);
  ASSERT_EQ(preview.nearest.size(), 3u);

  formation_command_t command{};
  command.action = formation_command_t::ACTION_APPLY;
  command.formation = formation;
  flight.FlyUntil(80.05);  // where the preview, too, had the command sent
  flight.Send(bus::channel::kCmdFormation, command);
  const double start = flight.tick->t_s;
  ProximityRules rules;
  rules.formations[1] = ProximityLimits();
  CylinderWatch watch({1, 2, 3}, {{1, 1}, {2, 1}, {3, 1}}, rules, {});
  SlotWatch slots(1);
  while (flight.tick->t_s < start + preview.duration_s) {
    const Tick& tick = flight.FlyUntil(flight.tick->t_s + 0.05);
    watch.Add(tick, tick.t_s - start);
    slots.Add(tick, tick.t_s - start);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const CylinderApproach& foreseen = preview.nearest[i];
    const CylinderApproach flown = watch.Worst(3)[i];
    EXPECT_EQ(foreseen.first_id, flown.first_id);
    EXPECT_EQ(foreseen.second_id, flown.second_id);
    EXPECT_NEAR(foreseen.horizontal_m, flown.horizontal_m, 2);
    EXPECT_NEAR(foreseen.vertical_m, flown.vertical_m, 2);
  }
  EXPECT_NEAR(preview.nearest[0].t_s, watch.Worst(1)[0].t_s, 0.5);
  EXPECT_NEAR(*preview.settle_s, slots.settled_since_s().value(), 1);
  for (const VehicleTick& vehicle : flight.tick->vehicles) {
    const TrackPoint& last = TrackOf(preview, vehicle.id).points.back();
    EXPECT_LT((last.position - Position(vehicle.truth)).norm(), 10);
  }
}

TEST(PreviewFormation, KeepsStrangersApartByTheScenariosCylinder) {
  CapturedFlight flight("crossing.json");
  flight.FlyUntil(20);
  FlightPicture picture = flight.Picture();
  const formation_t formation = flight.flights.at(1).formation;
  const auto worst = [&] {
    const Preview preview = PreviewFormation(picture, formation, {});
    // UAVs 1 to 3 are one formation, 4 to 6 the other.
    return std::ranges::find_if(preview.nearest,
                                [](const auto& pair) { return pair.first_id <= 3 && pair.second_id > 3; })
        ->cylinders;
  };
  const double usual = worst();
  picture.strangers.radius_m *= 2;
  picture.strangers.d_mod_m *= 2;
  picture.strangers.height_m *= 2;
  EXPECT_NEAR(worst(), usual / 2, 1e-6);
}

TEST(PreviewFormation, ClimbsNoHigherThanTheCeiling) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  FlightPicture picture = flight.Picture();
  picture.vehicles[2].lost = true;
  const double up_m = picture.vehicles[0].state->up_m;
  const auto highest_m = [&] {
    const Preview preview = PreviewFormation(picture, flight.flights.at(1).formation, {60, {}});
    double highest = 0;
    for (const TrackPoint& point : TrackOf(preview, 1).points)
      highest = std::max(highest, point.position.z());
    return highest;
  };
  EXPECT_GT(highest_m(), up_m + 150);
  picture.ceiling_m = up_m + 60;
  EXPECT_LT(highest_m(), up_m + 65);
}

TEST(PreviewFormation, FindsThatUavsWhoChangePlacesMeet) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  const Preview preview = PreviewFormation(flight.Picture(), Swapped(flight.flights.at(1).formation), {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  const CylinderApproach& least = preview.nearest.at(0);
  EXPECT_EQ(least.first_id, 2);
  EXPECT_EQ(least.second_id, 3);
  EXPECT_TRUE(least.inside());
  EXPECT_LT(least.horizontal_m, 50);
  EXPECT_FALSE(preview.nearest.at(1).inside());
}

TEST(PreviewFormation, SeesStrangersWhoFlyOn) {
  CapturedFlight flight("crossing.json");
  flight.FlyUntil(110);
  formation_t formation = flight.flights.at(1).formation;
  for (slot_t& slot : formation.slots) slot.forward_m -= 400;
  const Preview preview = PreviewFormation(flight.Picture(), formation, {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  const CylinderApproach& least = preview.nearest.at(0);
  EXPECT_LE(least.first_id, 3);
  EXPECT_GE(least.second_id, 4);
  EXPECT_TRUE(least.inside()) << least.horizontal_m << " " << least.vertical_m;
  EXPECT_LT(least.vertical_m, 100);
  EXPECT_FALSE(TrackOf(preview, least.second_id).points.empty());
}

TEST(PreviewFormation, RefusesWithTheControllersOwnReason) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(1);
  formation_t formation = flight.flights.at(1).formation;
  formation.slots[0].vehicle_id = 9;
  const Preview preview = PreviewFormation(flight.Picture(), formation, {});
  EXPECT_FALSE(preview.ok);
  EXPECT_EQ(preview.reason, "there is no UAV 9 in the fleet");
  EXPECT_TRUE(preview.tracks.empty());
}

TEST(PreviewFormation, NamesTheLimitsThatKeepUavsOutOfTheirSlots) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  formation_t formation = flight.flights.at(1).formation;
  formation.slots[1].forward_m += 3000;
  const Preview preview = PreviewFormation(flight.Picture(), formation, {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  const auto fast = std::find_if(preview.limits.begin(), preview.limits.end(), [](const BindingLimit& limit) {
    return limit.vehicle_id == 2 && limit.limit == "max_speed";
  });
  ASSERT_NE(fast, preview.limits.end());
  // It gains 38 m/s at most on the 50 m/s of its slot.
  EXPECT_GT(fast->t_s, 10);
  EXPECT_GT(fast->seconds, 5);
  for (const BindingLimit& limit : preview.limits) EXPECT_EQ(limit.vehicle_id, 2) << limit.limit;
}

TEST(PreviewFormation, KeepsAUavLostWhoseLinkIsLost) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  FlightPicture picture = flight.Picture();
  picture.vehicles[2].lost = true;
  const Preview preview = PreviewFormation(picture, flight.flights.at(1).formation, {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  const auto& lost = TrackOf(preview, 3).points;
  EXPECT_LE(lost.size(), 3u);
  EXPECT_NEAR(lost.back().position.z(), lost.front().position.z(), 2);
  EXPECT_NEAR(TrackOf(preview, 1).points.back().position.z(), 1200, 10);
}

TEST(PreviewFormation, LeavesOutAUavThatWasNeverHeard) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(80);
  FlightPicture picture = flight.Picture();
  picture.vehicles[2].state.reset();
  const Preview preview = PreviewFormation(picture, flight.flights.at(1).formation, {});
  ASSERT_TRUE(preview.ok) << preview.reason;
  EXPECT_EQ(preview.nearest.size(), 1u);
  EXPECT_EQ(preview.tracks.size(), 2u);
}

TEST(PreviewFormation, EndsWhenItIsTold) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(10);
  int asked = 0;
  const Preview preview = PreviewFormation(flight.Picture(), Swapped(flight.flights.at(1).formation),
                                           {.longest_s = 300, .stop = [&] { return ++asked > 100; }});
  EXPECT_TRUE(preview.ok);
  EXPECT_FALSE(preview.complete);
  EXPECT_NEAR(preview.duration_s, 5, 0.1);
}

TEST(PreviewPath, ShowsTheLineThatIsThenFlown) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(100);
  const path_command_t command =
      PathCommand({{0, 12000, 1000, 50}, {6000, 18000, 1100, 55}, {14000, 18000, 1100, 55}});
  const PathPreview preview = PreviewPath(flight.Picture(), command, {.longest_s = 3600, .stop = {}});
  ASSERT_TRUE(preview.flight.ok) << preview.flight.reason;
  ASSERT_TRUE(preview.path);
  EXPECT_TRUE(preview.problems.empty());
  EXPECT_TRUE(preview.flight.complete);
  ASSERT_EQ(preview.legs.size(), 3u);
  EXPECT_FALSE(preview.legs[0].from);
  EXPECT_EQ(preview.legs[2].to, 2u);
  EXPECT_NEAR(preview.legs[2].course_rad, 0, 1e-9);
  EXPECT_NEAR(preview.legs[1].time_s, preview.legs[1].length_m / 52.5, 5);

  flight.FlyUntil(100.05);  // where the preview, too, had the command sent
  flight.Send(bus::channel::kCmdPath, command);
  flight.FlyUntil(100.1);
  const Path& flown = flight.controller().flights().at(1).leader().path();
  ASSERT_EQ(flight.controller().flights().at(1).path_revision(), 2);
  for (double arc = preview.leader_arc_m; arc < flown.end_arc_m() + 5000; arc += 100) {
    EXPECT_LT((flown.At(arc).position - preview.path->At(arc).position).norm(), 0.5) << arc;
    EXPECT_NEAR(flown.At(arc).up_m, preview.path->At(arc).up_m, 0.1) << arc;
  }
}

TEST(PreviewPath, TellsTheLegsOfALoopInTheOrderInWhichTheyAreFlown) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(100);
  const path_command_t command = PathCommand(
      {{0, 12000, 1000, 50}, {12000, 12000, 1000, 50}, {12000, 0, 1000, 50}, {0, 0, 1000, 50}}, true);
  const PathPreview preview = PreviewPath(flight.Picture(), command, {.longest_s = 0, .stop = {}});
  ASSERT_TRUE(preview.path) << preview.flight.reason;
  ASSERT_EQ(preview.legs.size(), 5u);
  EXPECT_EQ(preview.flight.duration_s, 0);
  double lap = 0;
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(preview.legs[i].from, preview.legs[i - 1].to);
    EXPECT_EQ(preview.legs[i].to, (preview.legs[i - 1].to + 1) % 4);
    lap += preview.legs[i].length_m;
  }
  EXPECT_NEAR(lap, preview.path->lap_m(), 1);
}

TEST(PreviewPath, NamesEveryWaypointThatCannotBeFlown) {
  CapturedFlight flight("triangle.json");
  flight.FlyUntil(100);
  const PathPreview preview =
      PreviewPath(flight.Picture(),
                  PathCommand({{0, 12000, 1000, 95}, {9000, 12000, 1000, 50}, {9000, 0, 1000, 10}}), {});
  EXPECT_FALSE(preview.flight.ok);
  EXPECT_FALSE(preview.path);
  ASSERT_EQ(preview.problems.size(), 2u);
  EXPECT_EQ(preview.problems[0].waypoint, 0u);
  EXPECT_EQ(preview.problems[1].waypoint, 2u);
  EXPECT_EQ(preview.flight.reason, preview.problems[0].text);
}

}  // namespace
}  // namespace skein::experiment

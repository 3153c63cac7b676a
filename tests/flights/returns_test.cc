// Returns from a lost link in turns: the lost UAV flew straight on while its formation turned, and has to
// come back through the others' sky.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "flights/flight_tools.h"

namespace skein::flights {
namespace {

struct Return {
  config::Scenario scenario;
  double cut_s = 0;
  double lost_s = 0;
};

/// A formation of three to five in some shape, on a path of turns; the link of one of them is cut before or
/// in a turn.
/// With two of them, the second one's link is cut while the first one is away and the others climb.
Return RandomReturn(unsigned seed, double spacing_m, bool two = false) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  constexpr Shape kShapes[] = {Shape::kTriangle,    Shape::kColumn, Shape::kLineAbreast,
                               Shape::kEchelonLeft, Shape::kVee,    Shape::kDiamond};
  const int count = 3 + static_cast<int>(random() % 3);
  const Shape shape = kShapes[random() % std::size(kShapes)];
  const auto offsets = ShapeSlots(shape, count, spacing_m);
  const PathLimits limits = LimitsOf(std::vector<VehicleModel>(static_cast<std::size_t>(count)), offsets);
  const double tightest = LoiterRadius(limits, 50).value_or(2000);
  const double radius = between(std::max(1500.0, tightest), std::max(1500.0, tightest) + 1500);

  Return flight;
  config::FormationConfig formation;
  formation.id = 1;
  formation.name = std::string(Name(shape));
  formation.shape = shape;
  formation.spacing_m = spacing_m;
  formation.leader = {0, 0, 1000, 50, std::numbers::pi / 2};
  config::PathConfig path;
  const double straight = between(1500, 5000);
  path.legs.push_back({straight, 0, 0, 0, 0, 0});
  double side = random() % 2 ? 1 : -1;
  for (int turn = 0; turn < 3; ++turn) {
    path.legs.push_back({0, side * between(1, 3.1), radius, 0, 0, 0});
    path.legs.push_back({between(500, 4000), 0, 0, 0, 0, 0});
    if (random() % 2) side = -side;
  }
  formation.path = path;
  for (int i = 0; i < count; ++i) {
    const SlotOffset& offset = offsets[static_cast<std::size_t>(i)];
    formation.slots.push_back({i + 1, offset});
    config::VehicleConfig vehicle;
    vehicle.id = i + 1;
    vehicle.callsign = "UAV" + std::to_string(i + 1);
    vehicle.start = {-offset.left_m, offset.forward_m, 1000 + offset.up_m, 50, std::numbers::pi / 2, 0};
    flight.scenario.vehicles.push_back(vehicle);
  }
  flight.scenario.formations.push_back(formation);
  flight.scenario.name = "return";
  flight.cut_s = (1000 + straight) / 50 + between(-15, 60);
  flight.lost_s = between(36, 90);
  const int lost = 1 + static_cast<int>(random() % static_cast<unsigned>(count));
  config::CutLink cut;
  cut.vehicle_id = lost;
  cut.for_s = flight.lost_s;
  flight.scenario.timeline.push_back({flight.cut_s, cut});
  flight.scenario.duration_s = flight.cut_s + flight.lost_s + 300;
  if (two) {
    cut.vehicle_id = 1 + lost % count;
    cut.for_s = between(36, 90);
    const double cut_s = flight.cut_s + between(5, 30);  // the others are climbing
    flight.scenario.timeline.push_back({cut_s, cut});
    flight.scenario.duration_s = cut_s + *cut.for_s + 400;
  }
  return flight;
}

void FlyReturns(unsigned first_seed, int count, double spacing_m, bool two = false) {
  for (int i = 0; i < count; ++i) {
    const unsigned seed = first_seed + static_cast<unsigned>(i);
    const Return flight = RandomReturn(seed, spacing_m, two);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", spacing " + std::to_string(spacing_m));
    const ProximityLimits limits = flight.scenario.formations.at(0).proximity;
    double nearest = 1e9;
    double nearest_s = 0;
    bool path_refused = false;
    const auto summary = Fly(flight.scenario, [&](const experiment::Tick& tick) {
      for (const auto& event : tick.events) path_refused = path_refused || event.code == "path_refused";
      for (std::size_t a = 0; a < tick.vehicles.size(); ++a) {
        for (std::size_t b = a + 1; b < tick.vehicles.size(); ++b) {
          // Two that nobody can command may meet whatever the station does.
          if (tick.vehicles[a].uplink_cut && tick.vehicles[b].uplink_cut) continue;
          const double ratio = CylinderRatio(tick.vehicles[a].truth, tick.vehicles[b].truth, limits);
          if (ratio < nearest) nearest = ratio, nearest_s = tick.t_s;
        }
      }
    });
    EXPECT_FALSE(path_refused);
    EXPECT_GE(nearest, 1) << "inside a cylinder at " << nearest_s << " s, cut at " << flight.cut_s
                          << " s for " << flight.lost_s << " s";
    ASSERT_EQ(summary.drops.size(), two ? 2u : 1u);
    for (const auto& drop : summary.drops) {
      EXPECT_TRUE(drop.in_slot_s) << "UAV" << drop.vehicle_id << " did not come back into its slot";
    }
  }
}

TEST(ReturnInTurns, NobodyEntersACylinderAtThreeHundredMetresSpacing) { FlyReturns(1, 150, 300); }

TEST(ReturnInTurns, NobodyEntersACylinderAtFiveHundredMetresSpacing) { FlyReturns(1001, 150, 500); }

TEST(ReturnInTurns, NobodyEntersACylinderWhenTwoAreLostAtOnce) { FlyReturns(2001, 60, 400, true); }

}  // namespace
}  // namespace skein::flights

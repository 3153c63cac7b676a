#include "experiment/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace skein::experiment {
namespace {

config::Scenario TwoUavs() {
  config::Scenario scenario;
  scenario.name = "Two";
  for (int id = 1; id <= 2; ++id) {
    config::VehicleConfig vehicle;
    vehicle.id = id;
    vehicle.callsign = "UAV" + std::to_string(id);
    vehicle.start.speed_m_s = 50;
    scenario.vehicles.push_back(vehicle);
  }
  scenario.formations.emplace_back();
  return scenario;
}

/// UAV1 flies east at 50 m/s in the slot of formation 1, UAV2 in none and stands 1000 m north of the start.
Tick TickAt(std::int64_t number) {
  Tick tick;
  tick.number = number;
  tick.t_s = 0.05 * static_cast<double>(number);
  tick.vehicles.resize(2);
  tick.vehicles[0].id = 1;
  tick.vehicles[0].truth = {
      .east_m = 50 * tick.t_s, .north_m = 0, .up_m = 0, .speed_m_s = 50, .course_rad = 0, .climb_rad = 0};
  tick.vehicles[0].formation_id = 1;
  slot_status_t slot{};
  slot.vehicle_id = 1;
  slot.slot_east_m = 50 * tick.t_s;
  tick.vehicles[0].slot = slot;
  tick.vehicles[1].id = 2;
  tick.vehicles[1].truth = {
      .east_m = 0, .north_m = 1000, .up_m = 30, .speed_m_s = 50, .course_rad = 0, .climb_rad = 0};
  tick.formations[1].leader_speed_m_s = 50;
  return tick;
}

Summary Fly(int ticks, const std::function<void(Tick&)>& change) {
  SummaryBuilder builder(TwoUavs());
  for (int i = 0; i < ticks; ++i) {
    Tick tick = TickAt(i);
    change(tick);
    builder.Add(tick);
  }
  return builder.Finish();
}

TEST(Summary, SettlesWhenAnErrorStaysWithinTenMetres) {
  const Summary summary = Fly(200, [](Tick& tick) {
    slot_status_t& slot = *tick.vehicles[0].slot;
    slot.forward_error_m = 100 - 20 * tick.t_s;     // 10 m at 4.5 s, -10 m at 5.5 s, never again
    slot.left_error_m = tick.t_s < 3 ? -50 : -9.5;  // from 3 s on
    slot.up_error_m = 5;                            // from the start
  });
  EXPECT_FALSE(summary.vehicles[0].settling.forward_s);
  EXPECT_DOUBLE_EQ(*summary.vehicles[0].settling.left_s, 3);
  EXPECT_DOUBLE_EQ(*summary.vehicles[0].settling.up_s, 0);
  EXPECT_TRUE(summary.vehicles[0].in_formation);
  EXPECT_FALSE(summary.vehicles[1].in_formation);
  EXPECT_FALSE(summary.vehicles[1].settling.up_s);
}

TEST(Summary, MeasuresSpeedAgainstTheSlotsOwnSpeed) {
  // A slot on the outside of a turn, 60 m/s while its leader flies 50.
  const Summary summary = Fly(100, [](Tick& tick) {
    tick.vehicles[0].slot->slot_east_m = 60 * tick.t_s;
    tick.vehicles[0].truth.speed_m_s = tick.t_s < 2 ? 50 : 59.5;
  });
  EXPECT_DOUBLE_EQ(*summary.vehicles[0].settling.speed_s, 2);
  EXPECT_EQ(summary.vehicles[0].least_speed_m_s, 50);
  EXPECT_EQ(summary.vehicles[0].greatest_speed_m_s, 59.5);
}

TEST(Summary, KnowsTheLeastDistanceOfAPair) {
  const Summary summary = Fly(100, [](Tick& tick) { tick.vehicles[1].truth.east_m = 100; });
  ASSERT_EQ(summary.approaches.size(), 1u);
  EXPECT_DOUBLE_EQ(summary.approaches[0].t_s, 2);  // 100 m at 50 m/s
  EXPECT_DOUBLE_EQ(summary.approaches[0].horizontal_m, 1000);
  EXPECT_DOUBLE_EQ(summary.approaches[0].vertical_m, 30);
  EXPECT_DOUBLE_EQ(summary.approaches[0].distance_m, std::hypot(1000, 30));
}

TEST(Summary, FollowsALinkDropThroughToTheSlot) {
  const Summary summary = Fly(400, [](Tick& tick) {
    VehicleTick& vehicle = tick.vehicles[0];
    vehicle.uplink_cut = vehicle.downlink_cut = tick.t_s >= 2 && tick.t_s < 9;
    vehicle.downlink = tick.t_s >= 6 && tick.t_s < 12 ? Link::kLost : Link::kUp;
    vehicle.slot->left_error_m = tick.t_s > 3 && tick.t_s < 15 ? 80 : 0;
  });
  ASSERT_EQ(summary.drops.size(), 1u);
  const LinkDrop& drop = summary.drops[0];
  EXPECT_EQ(drop.vehicle_id, 1);
  EXPECT_TRUE(drop.uplink && drop.downlink);
  EXPECT_DOUBLE_EQ(drop.cut_s, 2);
  EXPECT_DOUBLE_EQ(*drop.found_s, 6);
  EXPECT_DOUBLE_EQ(*drop.restored_s, 9);
  EXPECT_DOUBLE_EQ(*drop.seen_up_s, 12);
  EXPECT_DOUBLE_EQ(*drop.in_slot_s, 15);
}

TEST(Summary, TellsDropsApartThatFollowOneAnother) {
  const Summary summary = Fly(400, [](Tick& tick) {
    tick.vehicles[1].downlink_cut = (tick.t_s >= 2 && tick.t_s < 4) || (tick.t_s >= 10 && tick.t_s < 17);
    tick.vehicles[1].downlink = tick.t_s >= 14 ? Link::kLost : Link::kUp;
  });
  ASSERT_EQ(summary.drops.size(), 2u);
  EXPECT_FALSE(summary.drops[0].found_s);
  EXPECT_FALSE(summary.drops[0].uplink);
  EXPECT_DOUBLE_EQ(*summary.drops[1].found_s, 14);
  EXPECT_FALSE(summary.drops[1].seen_up_s);
}

TEST(Summary, DoesNotTakeALossThatIsStillToldForTheNextCut) {
  const auto fly = [](double up_from_s) {
    return Fly(400, [up_from_s](Tick& tick) {
      tick.vehicles[1].downlink_cut = (tick.t_s >= 2 && tick.t_s < 8) || (tick.t_s >= 9 && tick.t_s < 17);
      const bool seen_up = tick.t_s >= up_from_s && tick.t_s < 14;
      tick.vehicles[1].downlink = tick.t_s >= 6 && !seen_up ? Link::kLost : Link::kUp;
    });
  };
  // Still told lost when it is cut again, then seen up, then found.
  const Summary found = fly(10);
  ASSERT_EQ(found.drops.size(), 2u);
  EXPECT_DOUBLE_EQ(*found.drops[0].found_s, 6);
  EXPECT_DOUBLE_EQ(*found.drops[1].found_s, 14);
  // Told lost all the time: nothing was found of the second one.
  const Summary not_found = fly(14);
  EXPECT_FALSE(not_found.drops[1].found_s);
  EXPECT_NE(ToText(not_found).find("UAV2 cut downwards at 9.00 s, while it was still told lost"),
            std::string::npos);
}

TEST(Summary, DoesNotCountErrorsAfterACutAsNotSettled) {
  const Summary summary = Fly(200, [](Tick& tick) {
    tick.vehicles[1].downlink_cut = tick.t_s >= 5;
    tick.vehicles[0].slot->forward_error_m = tick.t_s < 1 || tick.t_s >= 5 ? 100 : 0;
  });
  EXPECT_DOUBLE_EQ(*summary.vehicles[0].settling.forward_s, 1);
}

TEST(Summary, RemembersTheHighestLevelAndWithWhom) {
  const Summary summary = Fly(200, [](Tick& tick) {
    vehicle_proximity_t proximity{};
    proximity.level = tick.t_s >= 3 && tick.t_s < 4 ? 2 : 1;
    proximity.level_with_id = 2;
    tick.vehicles[0].proximity = proximity;
  });
  EXPECT_EQ(summary.vehicles[0].highest_level, 2);
  EXPECT_DOUBLE_EQ(summary.vehicles[0].highest_level_s, 3);
  EXPECT_EQ(summary.vehicles[0].highest_level_with_id, 2);
  EXPECT_EQ(summary.vehicles[1].highest_level, 0);
}

TEST(SummaryText, SaysWhatHappened) {
  const Summary summary = Fly(400, [](Tick& tick) {
    VehicleTick& vehicle = tick.vehicles[0];
    vehicle.uplink_cut = vehicle.downlink_cut = tick.t_s >= 2 && tick.t_s < 9;
    vehicle.downlink = tick.t_s >= 6 && tick.t_s < 12 ? Link::kLost : Link::kUp;
  });
  const std::string text = ToText(summary);
  EXPECT_EQ(text.substr(0, text.find('\n')), "Two, control skein: 2 UAVs, 19.95 s");
  EXPECT_NE(
      text.find(
          "UAV1 cut both ways at 2.00 s, found lost 4.00 s later; restored at 9.00 s, seen up 3.00 s later"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("UAV1 - UAV2: 1000.4 m (1000.0 m horizontally, 30.0 m vertically) at 0.00 s"),
            std::string::npos)
      << text;
}

TEST(SummaryText, OfNobodyIsShort) {
  config::Scenario nobody;
  nobody.name = "Empty";
  SummaryBuilder builder(nobody);
  builder.Add(Tick{});
  EXPECT_EQ(ToText(builder.Finish()), "Empty: 0 UAVs, 0.00 s\n");
}

}  // namespace
}  // namespace skein::experiment

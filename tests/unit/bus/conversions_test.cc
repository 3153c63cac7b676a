#include "bus/conversions.h"

#include <gtest/gtest.h>

#include <vector>

#include "bus/validate.h"

namespace skein::bus {
namespace {

// Every field has a value of its own, so that two that are mixed up show.

TEST(Conversions, CarryTheMotionOfAVehicle) {
  const VehicleState state{1, 2, 3, 4, 5, 6};
  const auto message = ToMessage(state);
  EXPECT_EQ(message.east_m, 1);
  EXPECT_EQ(message.climb_rad, 6);
  const auto back = ToVehicleState(message);
  EXPECT_EQ(back.north_m, 2);
  EXPECT_EQ(back.up_m, 3);
  EXPECT_EQ(back.speed_m_s, 4);
  EXPECT_EQ(back.course_rad, 5);
}

TEST(Conversions, CarryAVehicleModel) {
  const VehicleModel model{"glider", {0.1, 0.2, 0.3}, {20, 40, 1, 0.4, 0.5, 0.6}};
  const auto message = ToMessage(7, "UAV7", model, true);
  EXPECT_EQ(message.id, 7);
  EXPECT_EQ(message.callsign, "UAV7");
  EXPECT_TRUE(message.has_payload);
  EXPECT_EQ(message.k_course_per_s, 0.2);
  EXPECT_EQ(message.max_climb_rate_rad_s, 0.6);
  const auto back = ToVehicleModel(message);
  EXPECT_EQ(back.name, "glider");
  EXPECT_EQ(back.gains.speed_per_s, 0.1);
  EXPECT_EQ(back.gains.climb_per_s, 0.3);
  EXPECT_EQ(back.envelope.min_speed_m_s, 20);
  EXPECT_EQ(back.envelope.max_speed_m_s, 40);
  EXPECT_EQ(back.envelope.max_acceleration_m_s2, 1);
  EXPECT_EQ(back.envelope.max_course_rate_rad_s, 0.4);
  EXPECT_EQ(back.envelope.max_climb_rad, 0.5);
}

TEST(Conversions, CarrySlotsAndThresholds) {
  formation_t message;
  SetSlots(message, {{3, {-1000, 500, 20}}, {4, {-1500, -500, 0}}});
  SetProximityLimits(message,
                     {.radius_m = 1, .height_m = 2, .d_mod_m = 3, .advisory_tau_s = 5, .caution_tau_s = 4});
  EXPECT_EQ(message.num_slots, 2);
  const auto slots = ToSlots(message);
  EXPECT_EQ(slots[0].vehicle_id, 3);
  EXPECT_EQ(slots[0].offset.left_m, 500);
  EXPECT_EQ(slots[0].offset.up_m, 20);
  EXPECT_EQ(slots[1].offset.forward_m, -1500);
  const auto limits = ToProximityLimits(message);
  EXPECT_EQ(limits.radius_m, 1);
  EXPECT_EQ(limits.height_m, 2);
  EXPECT_EQ(limits.d_mod_m, 3);
  EXPECT_EQ(limits.advisory_tau_s, 5);
  EXPECT_EQ(limits.caution_tau_s, 4);
}

TEST(Conversions, CarryAPath) {
  const Path path(500, {{1000, {1, 2}, 0.5, 0, 0.001}, {2000, {3, 4}, 1, 0.001, 0}},
                  {{500, 900, 50, 0.01, 0.02, 0.03, 0.04}, {3000, 950, 55}}, 700.0);
  path_t message = ToMessage(path);
  message.formation_id = 1;
  EXPECT_TRUE(Valid(message));
  EXPECT_EQ(message.num_pieces, 2);
  EXPECT_EQ(message.num_profile, 2);
  const Path back = ToPath(message);
  EXPECT_EQ(back.start_arc_m(), 500);
  EXPECT_EQ(back.end_arc_m(), 3500);
  EXPECT_EQ(back.loop_start_m(), 700.0);
  for (const double arc_m : {0.0, 600.0, 1234.5, 3499.0, 9999.0}) {
    EXPECT_EQ(back.At(arc_m).position, path.At(arc_m).position) << arc_m;
    EXPECT_EQ(back.At(arc_m).up_m, path.At(arc_m).up_m) << arc_m;
    EXPECT_EQ(back.At(arc_m).speed_m_s, path.At(arc_m).speed_m_s) << arc_m;
  }
}

TEST(Conversions, CarryAnOpenPath) {
  const path_t message = ToMessage(Path::Straight({10, 20}, 0.3, 1000, 50));
  EXPECT_EQ(message.loop_start_m, -1);
  EXPECT_FALSE(ToPath(message).closed());
}

TEST(Conversions, CarryWaypoints) {
  path_command_t message;
  SetWaypoints(message, {{1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}});
  EXPECT_EQ(message.num_waypoints, 2);
  const auto back = ToWaypoints(message);
  EXPECT_EQ(back[0].turn_radius_m, 5);
  EXPECT_EQ(back[1].east_m, 6);
  EXPECT_EQ(back[1].speed_m_s, 9);
}

}  // namespace
}  // namespace skein::bus

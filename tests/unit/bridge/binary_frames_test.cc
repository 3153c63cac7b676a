#include "bridge/binary_frames.h"

#include <gtest/gtest.h>

#include "frame_reader.h"

namespace skein::bridge {
namespace {

using recording::FleetTable;
using Ints = std::vector<std::int32_t>;
using Floats = std::vector<float>;
using Bytes = std::vector<int>;

vehicle_info_t Info(std::int32_t id, bool has_payload) {
  vehicle_info_t info{};
  info.id = id;
  info.callsign = "UAV" + std::to_string(id);
  info.has_payload = has_payload;
  return info;
}

vehicle_state_t State(std::int32_t id, double first, bool payload_on) {
  vehicle_state_t state{};
  state.id = id;
  state.east_m = first;
  state.north_m = first + 1;
  state.up_m = first + 2;
  state.speed_m_s = first + 3;
  state.course_rad = 7;  // unwrapped: 7 - 2 pi
  state.climb_rad = -0.125;
  state.payload_on = payload_on;
  return state;
}

fleet_state_t States(const std::vector<vehicle_state_t>& vehicles) {
  fleet_state_t message{};
  message.vehicles = vehicles;
  return message;
}

TEST(MotionFrame, HasTheColumnsThatBrowsersExpect) {
  FleetTable fleet;
  fleet.Take({Info(2, true), Info(7, false), Info(9, true)});
  fleet.Take(States({State(7, 100, false)}), 5'000'000);
  fleet.Take(States({State(2, 10, true)}), 6'500'000);  // UAV 9 was never heard

  FrameReader frame(EncodeMotion(fleet, {1'577'836'800'050'000, 12.05}, 7'000'000));
  EXPECT_EQ(frame.kind, 1u);
  EXPECT_EQ(frame.version, 1u);
  EXPECT_EQ(frame.reserved, 0u);
  EXPECT_EQ(frame.count, 2u);
  EXPECT_EQ(frame.utime, 1'577'836'800'050'000.);
  EXPECT_EQ(frame.t_s, 12.05);
  EXPECT_EQ(frame.Ints(), (Ints{2, 7}));
  EXPECT_EQ(frame.Floats(), (Floats{10, 100}));
  EXPECT_EQ(frame.Floats(), (Floats{11, 101}));
  EXPECT_EQ(frame.Floats(), (Floats{12, 102}));
  EXPECT_EQ(frame.Floats(), (Floats{13, 103}));
  for (const float course_rad : frame.Floats()) EXPECT_NEAR(course_rad, 0.7168147, 0.5 / 2048);
  EXPECT_EQ(frame.Floats(), (Floats{-0.125f, -0.125f}));
  EXPECT_EQ(frame.Floats(), (Floats{0.5f, 2}));
  EXPECT_EQ(frame.Bytes(), (Bytes{3, 0}));
  EXPECT_TRUE(frame.at_end());
}

TEST(StatusFrame, HasTheColumnsThatBrowsersExpect) {
  FleetTable fleet;
  fleet.Take({Info(2, true), Info(7, false)});
  slot_status_t slot{};
  slot.vehicle_id = 7;
  slot.forward_error_m = 1.5;
  slot.left_error_m = -2.5;
  slot.up_error_m = 3.5;
  slot.flown = true;
  fleet.Take(4, {slot});
  proximity_t proximity{};
  vehicle_proximity_t near{};
  near.id = 7;
  near.level = 2;
  near.nearest_id = 2;
  near.nearest_horizontal_m = 510;
  near.nearest_vertical_m = 20;
  near.tau_id = 2;
  near.tau_s = 12.5;
  near.level_with_id = 2;
  proximity.vehicles = {near};
  EXPECT_TRUE(fleet.Take(proximity));
  EXPECT_FALSE(fleet.Take(proximity));
  link_status_t links{};
  vehicle_link_t link{};
  link.id = 7;
  link.downlink = link_status_t::LINK_LOST;
  link.uplink = link_status_t::LINK_LATE;
  link.downlink_age_s = 4.5;
  link.uplink_age_s = 2.25;
  link.estimated_east_m = 1;
  link.estimated_north_m = 2;
  link.estimated_up_m = 3;
  link.horizontal_uncertainty_m = 8;
  link.vertical_uncertainty_m = 4;
  links.links = {link};
  EXPECT_TRUE(fleet.Take(links));
  EXPECT_FALSE(fleet.Take(links));

  FrameReader frame(EncodeStatus(fleet, {1, -1}));
  EXPECT_EQ(frame.kind, 2u);
  EXPECT_EQ(frame.count, 2u);
  EXPECT_EQ(frame.t_s, -1);
  EXPECT_EQ(frame.Ints(), (Ints{2, 7}));
  EXPECT_EQ(frame.Ints(), (Ints{0, 4}));           // formation_id
  EXPECT_EQ(frame.Floats(), (Floats{0, 1.5f}));    // forward_error_m
  EXPECT_EQ(frame.Floats(), (Floats{0, -2.5f}));   // left_error_m
  EXPECT_EQ(frame.Floats(), (Floats{0, 3.5f}));    // up_error_m
  EXPECT_EQ(frame.Ints(), (Ints{0, 2}));           // nearest_id
  EXPECT_EQ(frame.Floats(), (Floats{-1, 510}));    // nearest_horizontal_m
  EXPECT_EQ(frame.Floats(), (Floats{-1, 20}));     // nearest_vertical_m
  EXPECT_EQ(frame.Ints(), (Ints{0, 2}));           // tau_id
  EXPECT_EQ(frame.Floats(), (Floats{-1, 12.5f}));  // tau_s
  EXPECT_EQ(frame.Ints(), (Ints{0, 2}));           // level_with_id
  EXPECT_EQ(frame.Floats(), (Floats{-1, 4.5f}));   // downlink_age_s
  EXPECT_EQ(frame.Floats(), (Floats{-1, 2.25f}));  // uplink_age_s
  EXPECT_EQ(frame.Floats(), (Floats{0, 1}));       // estimated_east_m
  EXPECT_EQ(frame.Floats(), (Floats{0, 2}));       // estimated_north_m
  EXPECT_EQ(frame.Floats(), (Floats{0, 3}));       // estimated_up_m
  EXPECT_EQ(frame.Floats(), (Floats{0, 8}));       // horizontal_uncertainty_m
  EXPECT_EQ(frame.Floats(), (Floats{0, 4}));       // vertical_uncertainty_m
  EXPECT_EQ(frame.Bytes(), (Bytes{0, 2}));         // level
  EXPECT_EQ(frame.Bytes(), (Bytes{3, 2}));         // downlink
  EXPECT_EQ(frame.Bytes(), (Bytes{3, 1}));         // uplink
  EXPECT_EQ(frame.Bytes(), (Bytes{0, 3}));         // flags
  EXPECT_TRUE(frame.at_end());
}

TEST(FleetTable, ForgetsWhoLeavesTheRosterAndWhoLeavesAFormation) {
  FleetTable fleet;
  fleet.Take({Info(1, true), Info(2, true)});
  slot_status_t first{};
  first.vehicle_id = 1;
  slot_status_t second{};
  second.vehicle_id = 2;
  fleet.Take(1, {first, second});
  fleet.Take(1, {second});
  EXPECT_EQ(fleet.rows().at(1).formation_id, 0);
  EXPECT_FALSE(fleet.rows().at(1).slot);
  EXPECT_EQ(fleet.rows().at(2).formation_id, 1);
  fleet.Take({Info(2, true)});
  EXPECT_EQ(fleet.rows().size(), 1u);
}

TEST(Frames, MayHoldNobody) {
  FrameReader motion(EncodeMotion({}, {}, 0));
  EXPECT_EQ(motion.count, 0u);
  EXPECT_TRUE(motion.at_end());
  EXPECT_TRUE(FrameReader(EncodeStatus({}, {})).at_end());
}

}  // namespace
}  // namespace skein::bridge

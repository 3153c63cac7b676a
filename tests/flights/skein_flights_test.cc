// Control "skein": what it promises beyond the paper's law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <skein/ack_t.hpp>
#include <skein/path_command_t.hpp>

#include "bus/channels.h"
#include "flights/flight_tools.h"

namespace skein::flights {
namespace {

constexpr double kNorth = std::numbers::pi / 2;

TEST(SkeinAssembly, IsInItsSlotWithinAMinuteFromThePapersStart) {
  Eigen::Vector3d settled(0, 0, 0);
  Eigen::Vector3d overshoot(0, 0, 0);
  double slowest = 1e9;
  double fastest = 0;
  const auto scenario = experiment::UnderControl(Shipped("paper-assembly.json"), "skein");
  Fly(scenario, [&](const experiment::Tick& tick) {
    const auto& uav = tick.vehicles.at(0);
    if (!uav.slot) return;
    const Eigen::Vector3d error = TrueError(uav, kNorth);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(error[axis]) > 10) settled[axis] = tick.t_s;
    }
    overshoot = overshoot.cwiseMax(-error);  // it starts behind, to the right and below
    slowest = std::min(slowest, uav.truth.speed_m_s);
    fastest = std::max(fastest, uav.truth.speed_m_s);
  });
  EXPECT_LE(settled.maxCoeff(), 60);
  EXPECT_LE(overshoot.maxCoeff(), 5);
  EXPECT_GE(slowest, 30);
  EXPECT_LE(fastest, 90);
}

double WorstError(const config::Scenario& scenario) {
  double worst = 0;
  Fly(scenario, [&](const experiment::Tick& tick) {
    for (const auto& uav : tick.vehicles) {
      if (uav.slot) worst = std::max(worst, TrueDistance(uav));
    }
  });
  return worst;
}

TEST(SkeinTurn, StaysInSlotThroughAHalfCircle) { EXPECT_LE(WorstError(Shipped("turn.json")), 5); }

TEST(SkeinTurn, StaysNearWhenUavsAndLinksAreNotAsBelieved) {
  for (const double scale : {0.7, 1.3}) {
    SCOPED_TRACE("autopilot gains times " + std::to_string(scale));
    config::Scenario scenario = Shipped("turn.json");
    for (auto& vehicle : scenario.vehicles) {
      const AutopilotGains& believed = vehicle.model.gains;
      vehicle.actual = AutopilotGains{scale * believed.speed_per_s, scale * believed.course_per_s,
                                      scale * believed.climb_per_s};
      vehicle.downlink = {0.2, 0, 0.1};
      vehicle.uplink = {0, 0, 0.1};
    }
    EXPECT_LE(WorstError(scenario), 20);
  }
}

TEST(SkeinTurn, TakesPathsOverTheBusInMidTurnWithoutAJump) {
  struct Upload {
    const char* what;
    bool closed;
    std::vector<Waypoint> waypoints;
  };
  const std::vector<Upload> uploads = {
      {"closed", true, {{8000, 0, 1000, 50}, {8000, 12000, 1000, 50}, {-6000, 12000, 1000, 50}}},
      {"open end", false, {{8000, 0, 1000, 50}, {14000, 0, 1000, 50}}},
      {"climbing", false, {{8000, 0, 1000, 50}, {16000, 0, 1500, 60}, {16000, 12000, 800, 45}}},
  };
  for (const Upload& upload : uploads) {
    SCOPED_TRACE(upload.what);
    config::Scenario scenario = Shipped("turn.json");
    scenario.duration_s = 700;
    bool accepted = false;
    const auto upload_at_75_s = [&](bus::Bus& operator_bus) {
      operator_bus.Subscribe<ack_t>(bus::channel::kAck, [&](const ack_t& ack) {
        accepted = ack.accepted;
        EXPECT_TRUE(ack.accepted) << ack.reason;
      });
      operator_bus.executor().At(operator_bus.executor().Now() + 75 * bus::kSecond, [&, upload] {
        path_command_t command;
        command.utime = operator_bus.executor().Now();
        command.session_id = operator_bus.session_id();
        command.request_id = 1;
        command.to_session_id = operator_bus.session_id();
        command.formation_id = 1;
        command.closed = upload.closed;
        for (const Waypoint& from : upload.waypoints) {
          waypoint_t waypoint;
          waypoint.east_m = from.east_m;
          waypoint.north_m = from.north_m;
          waypoint.up_m = from.up_m;
          waypoint.speed_m_s = from.speed_m_s;
          waypoint.turn_radius_m = 0;
          command.waypoints.push_back(waypoint);
        }
        command.num_waypoints = static_cast<int>(command.waypoints.size());
        operator_bus.Publish(bus::channel::kCmdPath, command);
      });
    };
    const Envelope envelope;
    std::map<int, vehicle_command_t> last;
    double worst = 0;
    Fly(
        scenario,
        [&](const experiment::Tick& tick) {
          for (const auto& uav : tick.vehicles) {
            if (uav.slot) worst = std::max(worst, TrueDistance(uav));
            if (!uav.command) continue;
            const vehicle_command_t& now = *uav.command;
            EXPECT_LE(std::abs(now.setpoint_acceleration_m_s2), envelope.max_acceleration_m_s2 + 1e-9);
            EXPECT_LE(std::abs(now.setpoint_course_rate_rad_s), envelope.max_course_rate_rad_s + 1e-9);
            EXPECT_LE(std::abs(now.setpoint_climb_rate_rad_s), envelope.max_climb_rate_rad_s + 1e-9);
            if (const auto before = last.find(uav.id); before != last.end()) {
              const vehicle_command_t& then = before->second;
              EXPECT_LE(std::abs(now.setpoint_speed_m_s - then.setpoint_speed_m_s), 0.2) << "at " << tick.t_s;
              EXPECT_LE(std::abs(WrapAngle(now.setpoint_course_rad - then.setpoint_course_rad)), 0.02)
                  << tick.t_s;
              EXPECT_LE(std::abs(now.setpoint_climb_rad - then.setpoint_climb_rad), 0.02)
                  << "at " << tick.t_s;
            }
            last[uav.id] = now;
          }
        },
        upload_at_75_s);
    EXPECT_TRUE(accepted);
    EXPECT_LE(worst, 5);
  }
}

}  // namespace
}  // namespace skein::flights

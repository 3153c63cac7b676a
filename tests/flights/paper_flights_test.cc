// The experiments of [1], sections III.D and IV, with what they promise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flights/flight_tools.h"

namespace skein::flights {
namespace {

constexpr double kNorth = std::numbers::pi / 2;

TEST(PaperAssembly, SettlesAsFigureSixShows) {
  Eigen::Vector3d settled(0, 0, 0);
  double speed_settled = 0;
  double fastest = 0;
  Fly(Shipped("paper-assembly.json"), [&](const experiment::Tick& tick) {
    const auto& uav = tick.vehicles.at(0);
    ASSERT_TRUE(uav.slot || tick.number == 0);
    if (!uav.slot) return;
    const Eigen::Vector3d error = TrueError(uav, kNorth);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(error[axis]) > 10) settled[axis] = tick.t_s;
    }
    if (std::abs(uav.truth.speed_m_s - 50) > 1) speed_settled = tick.t_s;
    fastest = std::max(fastest, uav.truth.speed_m_s);
  });
  EXPECT_LE(settled.x(), 190) << "forward";
  EXPECT_LE(settled.y(), 50) << "left";
  EXPECT_LE(settled.z(), 50) << "up";
  EXPECT_GE(settled.x(), 100) << "the paper's law is not as quick as this";
  EXPECT_LE(speed_settled, 195);
  EXPECT_LE(fastest, 60.5);
}

/// One flight of section IV with the cut (and the return) somewhat later.
void FlyLinkDrop(double later_s) {
  SCOPED_TRACE("cut " + std::to_string(later_s) + " s later");
  config::Scenario scenario = Shipped("paper-link-drop.json");
  for (auto& entry : scenario.timeline) entry.at_s += later_s;
  const double cut = 200 + later_s;
  const double back = 235 + later_s;
  const double planned = 1000;

  double found = 1e9;
  double highest_level = 0;
  double up_at_return = 1e9;
  double altitude_error_after = 0;
  double lost_altitude_error = 0;
  double altitude_at_cut = 0;
  double end_error = 0;
  Fly(scenario, [&](const experiment::Tick& tick) {
    const auto& lost = tick.vehicles.at(2);
    if (tick.t_s >= cut && lost.link() == experiment::Link::kLost) found = std::min(found, tick.t_s - cut);
    EXPECT_TRUE(tick.t_s >= cut || lost.link() != experiment::Link::kLost)
        << "a loss that there was not, at " << tick.t_s;
    for (const auto& uav : tick.vehicles)
      highest_level = std::max(highest_level, static_cast<double>(uav.level()));
    if (tick.t_s <= cut) altitude_at_cut = lost.truth.up_m;
    if (tick.t_s > cut && tick.t_s < back) {
      lost_altitude_error = std::max(lost_altitude_error, std::abs(lost.truth.up_m - altitude_at_cut));
    }
    for (int i : {0, 1}) {
      const double up = tick.vehicles.at(static_cast<std::size_t>(i)).truth.up_m;
      if (std::abs(tick.t_s - back) < 0.01) up_at_return = std::min(up_at_return, up - planned);
      if (tick.t_s >= back + 85)
        altitude_error_after = std::max(altitude_error_after, std::abs(up - planned));
    }
    if (std::abs(tick.t_s - 400) < 0.01) {
      for (const auto& uav : tick.vehicles)
        end_error = std::max(end_error, TrueError(uav, kNorth).cwiseAbs().maxCoeff());
    }
  });
  EXPECT_LE(found, 5);
  EXPECT_GE(up_at_return, 190);
  EXPECT_LE(altitude_error_after, 2);
  EXPECT_LE(lost_altitude_error, 2);
  EXPECT_LE(highest_level, 2);
  EXPECT_LE(end_error, 10);
}

TEST(PaperLinkDrop, FindsTheLossClimbsAndComesBackAsFigureEightShows) { FlyLinkDrop(0); }

TEST(PaperLinkDrop, FindsTheLossWithinFiveSecondsWhateverThePhase) {
  for (double later = 0.05; later < 1.2; later += 0.15) FlyLinkDrop(later);
}

}  // namespace
}  // namespace skein::flights

#include <unistd.h>

#include <filesystem>

#include "unit/controller/controller_fixture.h"

namespace skein::controller {
namespace {

TEST_F(ControllerNodeTest, GoesOnWhereAKilledControllerWas) {
  options_.state_file =
      std::filesystem::temp_directory_path() / ("skein_state_" + std::to_string(::getpid()));
  Start();
  SendRoster();
  Fly(30);
  path_command_t path{};
  path.utime = executor_.Now();
  path.session_id = 77;
  path.request_id = ++request_id_;
  path.to_session_id = bus_.session_id();
  path.formation_id = 1;
  for (const Waypoint& waypoint : std::vector<Waypoint>{{0, 6000, 1000, 50}, {9000, 9000, 1000, 50}}) {
    path.waypoints.push_back(bus::ToMessage(waypoint));
  }
  path.num_waypoints = 2;
  station_.Publish(bus::channel::kCmdPath, path);
  executor_.Deliver();
  ASSERT_TRUE(ack_.accepted) << ack_.reason;
  Fly(30);
  ASSERT_TRUE(Ask(Command(formation_command_t::ACTION_HOLD)).accepted);
  Fly(30);
  const double arc = node_->flights().at(1).leader().arc_m();
  const double east_m = node_->flights().at(1).leader().path().At(arc).position.x();
  node_.reset();

  // Another process with nothing but the file.
  bus::Transport transport = bus::MakeTransport("memq://");
  bus::SimulatedExecutor executor(transport.lcm, executor_.Now());
  bus::Bus other(transport.lcm, "formation-controller", executor);
  bus::Bus station(transport.lcm, "test", executor);
  FormationControllerNode restarted(other, options_);
  fleet_state_t state{};
  state.utime = executor.Now();
  state.session_id = 1;
  state.tick = tick_;
  state.chunk_count = 1;
  bus::PublishChunks(station, bus::channel::kFleetState, state);
  executor.RunFor(2 * bus::kSecond);  // the roster comes late; the file must not be overwritten until then
  fleet_roster_t roster = Roster(executor.Now());
  bus::PublishChunks(station, bus::channel::kFleetRoster, roster);
  executor.Deliver();
  ASSERT_EQ(restarted.flights().size(), 1u);
  const FormationFlight& flight = restarted.flights().at(1);
  EXPECT_EQ(flight.waypoints().size(), 2u);
  EXPECT_TRUE(flight.holding()) << "and Resume knows the path";
  EXPECT_NEAR(flight.leader().arc_m(), arc, 60) << "as of the last second";
  EXPECT_NEAR(flight.leader().path().At(arc).position.x(), east_m, 1e-6);

  roster.start_utime += 1;  // another flight: the file is of no use
  roster.session_id = 2;
  bus::PublishChunks(station, bus::channel::kFleetRoster, roster);
  executor.Deliver();
  EXPECT_EQ(restarted.flights().at(1).waypoints().size(), 2u) << "a roster by itself ends no flight";
  state.utime = executor.Now();
  state.session_id = 2;
  bus::PublishChunks(station, bus::channel::kFleetState, state);
  executor.Deliver();
  EXPECT_TRUE(restarted.flights().at(1).waypoints().empty());
  std::filesystem::remove(options_.state_file);
}

/// A controller that was killed, and another process that goes on with nothing but its file.
class KilledControllerTest : public ControllerNodeTest {
 protected:
  KilledControllerTest() {
    options_.state_file =
        std::filesystem::temp_directory_path() / ("skein_killed_" + std::to_string(::getpid()));
    Start();
    SendRoster();
    Fly(20);
    silent_ = 3;
  }
  ~KilledControllerTest() override { std::filesystem::remove(options_.state_file); }

  static void TellLost(bus::Bus& from, int id) {
    link_status_t links{};
    links.utime = from.executor().Now();
    links.chunk_count = 1;
    vehicle_link_t link{};
    link.id = id;
    link.downlink = link_status_t::LINK_LOST;
    links.links.push_back(link);
    links.num_links = 1;
    from.Publish(bus::channel::kLinkStatus, links);
  }

  /// What the other one tells at its first ticks; UAV3 stays silent.
  std::vector<formation_status_t> GoOn(bus::Utime after, bool tell_lost) {
    node_.reset();
    bus::Transport transport = bus::MakeTransport("memq://");
    bus::SimulatedExecutor executor(transport.lcm, executor_.Now() + after);
    bus::Bus other(transport.lcm, "formation-controller", executor);
    bus::Bus station(transport.lcm, "test", executor);
    std::vector<formation_status_t> told;
    station.Subscribe<formation_status_t>(bus::channel::kFormationStatus,
                                          [&](const formation_status_t& status) { told.push_back(status); });
    options_.status_every_ticks = 1;
    const FormationControllerNode restarted(other, options_);
    bus::PublishChunks(station, bus::channel::kFleetRoster, Roster(executor.Now()));
    if (tell_lost) TellLost(station, 3);
    for (int i = 0; i < 3; ++i) {
      bus::PublishChunks(station, bus::channel::kFleetState,
                         State(executor.Now(), tick_ + after / FlightBench::kTick + i));
      executor.RunFor(FlightBench::kTick);
    }
    return told;
  }
};

TEST_F(KilledControllerTest, GoesOnWithTheClimbThatItWasIn) {
  Fly(80);
  TellLost(station_, 3);
  Fly(130);  // to half a second after the state was kept
  ASSERT_EQ(status_.mode, formation_status_t::MODE_AVOIDING);
  ASSERT_EQ(status_.avoidance_rate_m_s, 10);
  const formation_status_t before = node_->flights().at(1).Status(tick_);
  constexpr bus::Utime kGap = bus::kSecond / 2;
  const auto told = GoOn(kGap, false);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().mode, formation_status_t::MODE_AVOIDING) << told.front().mode_text;
  EXPECT_EQ(told.front().mode_utime, before.mode_utime);
  EXPECT_EQ(told.front().avoidance_target_m, before.avoidance_target_m);
  EXPECT_NEAR(told.front().avoidance_up_m,
              before.avoidance_up_m + 10 * bus::ToSeconds(told.front().utime - before.utime), 1e-6);
}

TEST_F(KilledControllerTest, AvoidsAUavThatHasBeenSilentSinceBefore) {
  Fly(60);
  ASSERT_EQ(status_.avoidance_target_m, 0) << "nobody has called it lost yet";
  const auto told = GoOn(bus::kSecond / 2, true);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().mode, formation_status_t::MODE_AVOIDING) << told.back().mode_text;
  EXPECT_EQ(told.back().avoidance_target_m, 200);
}

}  // namespace
}  // namespace skein::controller

#include "controller/formation_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "unit/controller/flight_bench.h"

namespace skein::controller {
namespace {

using std::numbers::pi;

config::FormationConfig Triangle(double spacing_m = 500, const std::string& control = "skein") {
  config::FormationConfig config;
  config.id = 1;
  config.name = "Triangle";
  config.control = control;
  config.shape = Shape::kTriangle;
  config.spacing_m = spacing_m;
  const auto offsets = ShapeSlots(Shape::kTriangle, 3, spacing_m);
  for (int id = 1; id <= 3; ++id) config.slots.push_back({id, offsets[static_cast<std::size_t>(id - 1)]});
  return config;
}

Path Northbound() { return Path::Straight({0, 0}, pi / 2, 1000, 50); }

Path TurnOf(double turn_rad) {
  PathLeg straight;
  straight.length_m = 2000;
  PathLeg turn;
  turn.turn_rad = turn_rad;
  turn.turn_radius_m = 2000;
  const auto config = Triangle();
  std::vector<SlotOffset> offsets;
  for (const Slot& slot : config.slots) offsets.push_back(slot.offset);
  const PathLimits limits = LimitsOf(std::vector<VehicleModel>(3), offsets);
  const auto planned = PlanLegs({0, 0}, pi / 2, 1000, 50, {straight, turn, straight}, limits);
  EXPECT_TRUE(planned.path) << planned.reason;
  return *planned.path;
}

/// What no tick may show, whatever the operator does: set-points that jump, rates outside of the envelope,
/// slots that jump.
class SmoothFlight {
 public:
  void Look(const FlightBench& bench, const FlightStep& step) {
    const Envelope envelope;
    constexpr double kTick = FlightBench::kStep;
    for (const FlightCommand& command : step.commands) {
      const LawOutput& now = command.output;
      EXPECT_LE(std::abs(now.rates.acceleration_m_s2), envelope.max_acceleration_m_s2 + 1e-9);
      EXPECT_LE(std::abs(now.rates.course_rate_rad_s), envelope.max_course_rate_rad_s + 1e-9);
      EXPECT_LE(std::abs(now.rates.climb_rate_rad_s), envelope.max_climb_rate_rad_s + 1e-9);
      const auto last = setpoints_.find(command.vehicle_id);
      if (last != setpoints_.end()) {
        EXPECT_LE(std::abs(now.setpoint.speed_m_s - last->second.speed_m_s),
                  2 * envelope.max_acceleration_m_s2 * kTick)
            << "UAV " << command.vehicle_id << " at " << bench.time_s() << " s";
        EXPECT_LE(std::abs(now.setpoint.course_rad - last->second.course_rad),
                  envelope.max_course_rate_rad_s * kTick)
            << "UAV " << command.vehicle_id << " at " << bench.time_s() << " s";
        EXPECT_LE(std::abs(now.setpoint.climb_rad - last->second.climb_rad),
                  2 * envelope.max_climb_rate_rad_s * kTick)
            << "UAV " << command.vehicle_id << " at " << bench.time_s() << " s";
      }
      setpoints_[command.vehicle_id] = now.setpoint;
      worst_error_m_ = std::max(worst_error_m_, bench.Error(command.vehicle_id).norm());
    }
  }

  void Fly(FlightBench& bench, double seconds) {
    for (double until = bench.time_s() + seconds - 1e-6; bench.time_s() < until;) Look(bench, bench.Tick());
  }

  double worst_error_m() const { return worst_error_m_; }

 private:
  std::map<int, AutopilotInput> setpoints_;
  double worst_error_m_ = 0;
};

TEST(FormationFlight, StaysInItsSlotsThroughATurn) {
  FlightBench bench(Triangle(), TurnOf(pi));
  SmoothFlight smooth;
  smooth.Fly(bench, 250);
  EXPECT_LE(smooth.worst_error_m(), 1);
  EXPECT_EQ(bench.flight.Status(0).mode, formation_status_t::MODE_IN_FORMATION);
}

TEST(FormationFlight, TakesANewPathInMidTurnWithoutAJump) {
  FlightBench bench(Triangle(), TurnOf(pi));
  SmoothFlight smooth;
  smooth.Fly(bench, 75);  // the leader is in the turn, the UAVs are about to enter it
  ASSERT_EQ(bench.flight.TakePath({{10000, 0, 1200, 60}, {10000, 12000, 1000, 50}, {-4000, 12000, 1100, 50}},
                                  true, bench.fleet),
            "");
  smooth.Fly(bench, 900);
  EXPECT_LE(smooth.worst_error_m(), 5);
}

TEST(FormationFlight, FollowsAClimbingPath) {
  FlightBench bench(Triangle(), Northbound());
  SmoothFlight smooth;
  smooth.Fly(bench, 5);
  ASSERT_EQ(bench.flight.TakePath({{0, 8000, 1000, 50}, {0, 14000, 1600, 50}, {6000, 20000, 900, 55}}, false,
                                  bench.fleet),
            "");
  smooth.Fly(bench, 500);
  EXPECT_LE(smooth.worst_error_m(), 5);
}

TEST(FormationFlight, LoitersAtAnOpenEnd) {
  FlightBench bench(Triangle(), Northbound());
  SmoothFlight smooth;
  ASSERT_EQ(bench.flight.TakePath({{0, 6000, 1000, 50}, {0, 12000, 1000, 50}}, false, bench.fleet), "");
  smooth.Fly(bench, 900);
  EXPECT_LE(smooth.worst_error_m(), 5);
  const formation_status_t status = bench.flight.Status(0);
  EXPECT_EQ(status.mode, formation_status_t::MODE_HOLDING);
  EXPECT_LT(std::hypot(status.leader_east_m, status.leader_north_m - 12000), 8000) << "it stays there";
}

TEST(FormationFlight, HoldsAndResumesWithoutAJump) {
  FlightBench bench(Triangle(), TurnOf(pi));
  SmoothFlight smooth;
  smooth.Fly(bench, 70);
  ASSERT_EQ(bench.flight.Hold(bench.fleet), "");
  EXPECT_EQ(bench.flight.Hold(bench.fleet), "") << "once more does nothing";
  smooth.Fly(bench, 600);
  EXPECT_EQ(bench.flight.Status(0).mode, formation_status_t::MODE_HOLDING);
  EXPECT_EQ(bench.flight.Status(0).mode_text, "loitering: hold");
  ASSERT_EQ(bench.flight.Resume(bench.fleet), "");
  smooth.Fly(bench, 900);
  EXPECT_LE(smooth.worst_error_m(), 5);
  EXPECT_NE(bench.flight.Status(0).mode, formation_status_t::MODE_HOLDING);
  EXPECT_NE(bench.flight.Resume(bench.fleet), "") << "nothing to resume";
}

TEST(FormationFlight, GoesStraightOnWhenItsPathIsTakenAway) {
  FlightBench bench(Triangle(), TurnOf(pi));
  SmoothFlight smooth;
  smooth.Fly(bench, 70);
  ASSERT_EQ(bench.flight.TakePath({}, false, bench.fleet), "");
  smooth.Fly(bench, 300);
  EXPECT_LE(smooth.worst_error_m(), 5);
  EXPECT_NEAR(bench.flight.leader().path().At(bench.flight.leader().arc_m()).curvature_per_m, 0, 1e-9);
}

TEST(FormationFlight, MovesToNewSlotsAndRefusesOnesThatItsPathIsTooTightFor) {
  FlightBench bench(Triangle(), TurnOf(pi));
  bench.Fly(5);
  ASSERT_EQ(bench.flight.Edit(Triangle(700), bench.fleet), "");
  bench.Fly(60);
  for (int id : {1, 2, 3}) EXPECT_LE(bench.Error(id).norm(), 5);

  const std::string refused = bench.flight.Edit(Triangle(9000), bench.fleet);
  EXPECT_NE(refused.find("path"), std::string::npos) << refused;
  EXPECT_DOUBLE_EQ(bench.flight.config().spacing_m, 700);

  auto nonsense = Triangle(700);
  nonsense.gains["no_such_gain"] = 1;
  EXPECT_NE(bench.flight.Edit(nonsense, bench.fleet).find("no_such_gain"), std::string::npos);
  EXPECT_TRUE(bench.flight.config().gains.empty());
}

TEST(FormationFlight, WidensTheCircleThatItHoldsOn) {
  FlightBench bench(Triangle(300), Northbound());
  bench.Fly(10);
  ASSERT_EQ(bench.flight.Hold(bench.fleet), "");
  bench.Fly(200);
  ASSERT_EQ(bench.flight.Edit(Triangle(600), bench.fleet), "");
  bench.Fly(300);
  for (int id : {1, 2, 3}) EXPECT_LE(bench.Error(id).norm(), 5);
  EXPECT_TRUE(bench.flight.holding());
}

TEST(FormationFlight, RefusesToDropAMemberWhoseLinkIsLost) {
  FlightBench bench(Triangle(), Northbound());
  bench.Fly(5);
  bench.Cut(3);
  bench.Fly(8);
  auto pair = Triangle();
  pair.slots.pop_back();
  EXPECT_NE(bench.flight.Edit(pair, bench.fleet).find("link"), std::string::npos);
  bench.Restore(3);
  bench.Fly(60);
  EXPECT_EQ(bench.flight.Edit(pair, bench.fleet), "");
}

TEST(FormationFlight, GoesOnWhenTheFleetsClockIsSet) {
  FlightBench bench(Triangle(), Northbound());
  bench.Fly(5);
  const double arc = bench.flight.leader().arc_m();
  bench.flight.TakeClock(5'000'000);
  EXPECT_DOUBLE_EQ(bench.flight.leader().arc_m(), arc);
  for (auto& [id, view] : bench.fleet) view.TakeClock(5'000'000);
  EXPECT_EQ(bench.flight.Step(bench.fleet, 5'050'000).commands.size(), 3u);
  EXPECT_NEAR(bench.flight.leader().arc_m(), arc + 2.5, 0.01);
}

TEST(FormationFlight, FliesUnderThePapersLawToo) {
  FlightBench bench(Triangle(500, "paper"), Northbound());
  bench.uavs.at(1).state.up_m -= 100;
  bench.uavs.at(3).state.east_m += 150;
  bench.Fly(200);
  for (int id : {1, 2, 3}) EXPECT_LE(bench.Error(id).norm(), 10);
}

TEST(FormationFlight, TellsWhatItDoesWhenALinkIsLostAndComesBack) {
  FlightBench bench(Triangle(), TurnOf(pi));
  std::set<std::string> texts;
  const auto fly = [&](double seconds) {
    for (double until = bench.time_s() + seconds; bench.time_s() < until;) {
      bench.Tick();
      texts.insert(bench.flight.Status(0).mode_text);
    }
  };
  fly(70);
  bench.Cut(3);
  fly(10);
  EXPECT_EQ(bench.flight.Status(0).mode, formation_status_t::MODE_AVOIDING);
  EXPECT_GT(bench.flight.Status(0).mode_end_utime, bench.flight.Status(0).utime);
  fly(50);
  EXPECT_DOUBLE_EQ(bench.flight.Status(0).avoidance_up_m, 200);
  EXPECT_TRUE(texts.contains("climbing 200 m: link of UAV3 lost"));
  EXPECT_TRUE(texts.contains("climbing 200 m (8 m to go): link of UAV3 lost"));
  EXPECT_TRUE(texts.contains("200 m above the planned altitude: link of UAV3 lost"));
  bench.Restore(3);
  fly(10);
  EXPECT_EQ(bench.flight.Status(0).mode, formation_status_t::MODE_REJOINING);
  fly(200);
  EXPECT_EQ(bench.flight.Status(0).mode_text, "in formation");
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const std::string& text) {
    return text.starts_with("descending 200 m (100 m to go)") ||
           text == "descending 200 m to the planned altitude (100 m to go)";
  }));
  EXPECT_GT(bench.LeastSeparation(), 1);
}

TEST(FormationFlight, ClimbsOutOfTheWayNoFasterThanASlowUavCan) {
  // 32 m/s at 80% of 0.35 rad is 8.8 m/s.
  FlightBench bench(Triangle(), Path::Straight({0, 0}, pi / 2, 1000, 32));
  bench.Fly(5);
  bench.Cut(3);
  double fastest = 0;
  double worst = 0;
  for (int tick = 0; tick < 1200; ++tick) {
    bench.Tick();
    fastest = std::max(fastest, bench.flight.Status(0).avoidance_rate_m_s);
    worst = std::max(worst, bench.Error(1).norm());
  }
  EXPECT_DOUBLE_EQ(bench.flight.Status(0).avoidance_up_m, 200);
  EXPECT_LE(fastest, 9);
  EXPECT_LE(worst, 3);
}

TEST(FormationFlight, FliesAloneAndWithNobodyHeard) {
  config::FormationConfig one = Triangle();
  one.slots = {{1, {-1000, 0, 0}}};
  FlightBench bench(one, TurnOf(pi));
  SmoothFlight smooth;
  smooth.Fly(bench, 200);
  EXPECT_LE(smooth.worst_error_m(), 1);

  FormationFlight unheard(Triangle(), VirtualLeader(Northbound(), 0, 0), {});
  EXPECT_TRUE(unheard.Step({}, 50'000).commands.empty());
  EXPECT_EQ(unheard.Status(0).mode, formation_status_t::MODE_WAITING);
}

}  // namespace
}  // namespace skein::controller

#include "simulator/simulated_vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein::simulator {
namespace {

constexpr bus::Utime kTick = 50'000;
constexpr bus::Utime kStart = 1'577'836'800'000'000;

config::VehicleConfig Config() {
  config::VehicleConfig config;
  config.id = 3;
  config.callsign = "UAV3";
  config.start = {
      .east_m = 100, .north_m = 200, .up_m = 1000, .speed_m_s = 50, .course_rad = std::numbers::pi / 2};
  return config;
}

FlightCommand CommandSpeed(double speed_m_s, std::int64_t sequence, std::int64_t session_id = 10) {
  return {session_id, sequence, {speed_m_s, std::numbers::pi / 2, 0}};
}

/// Flies tick by tick, with an action at the beginning of each (its number counts on from call to call).
struct Flight {
  SimulatedVehicle vehicle;
  std::int64_t tick = 0;

  explicit Flight(const config::VehicleConfig& config, std::uint64_t seed = 1)
      : vehicle(config, kStart, seed) {}
  bus::Utime now() const { return kStart + tick * kTick; }
  void Fly(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const bus::Utime utime = kStart + ++tick * kTick;
      vehicle.Hear(utime);
      vehicle.ArriveAt(utime, Step(vehicle.state(), vehicle.input(), vehicle.model(), bus::ToSeconds(kTick)));
    }
  }
  template <typename Action>
  void Fly(int ticks, Action&& action) {
    for (int i = 0; i < ticks; ++i) {
      action();
      Fly(1);
    }
  }
};

TEST(SimulatedVehicle, HoldsCourseSpeedAndAltitudeBeforeAnyCommand) {
  Flight flight(Config());
  flight.Fly(2000);
  EXPECT_NEAR(flight.vehicle.state().east_m, 100, 1e-6);
  EXPECT_NEAR(flight.vehicle.state().north_m, 200 + 50 * 100, 1e-6);
  EXPECT_NEAR(flight.vehicle.state().up_m, 1000, 1e-9);
  EXPECT_EQ(flight.vehicle.state().speed_m_s, 50);
}

TEST(SimulatedVehicle, ObeysACommandInTheStepInWhichItArrives) {
  Flight flight(Config());
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.Fly(1);
  // v' = 0.01 * (60 - 50) for 50 ms
  EXPECT_NEAR(flight.vehicle.state().speed_m_s, 50 + 10 * (1 - std::exp(-0.01 * 0.05)), 1e-9);
  const auto report = flight.vehicle.Telemetry();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->command_session_id, 10);
  EXPECT_EQ(report->command_sequence, 1);
}

TEST(SimulatedVehicle, ReportsItsStateWithItsTime) {
  Flight flight(Config());
  flight.Fly(20);
  const auto report = flight.vehicle.Telemetry();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->id, 3);
  EXPECT_EQ(report->utime, kStart + 20 * kTick);
  EXPECT_NEAR(report->north_m, 250, 1e-9);
  EXPECT_EQ(report->command_session_id, 0);
  EXPECT_EQ(report->command_sequence, 0);
  EXPECT_FALSE(report->payload_on);
}

TEST(SimulatedVehicle, RefusesOldSequencesAndOldSessionsAndLaterOnesUntilItsOwnFallsSilent) {
  Flight flight(Config());
  const auto speed_input_after = [&](const FlightCommand& command) {
    flight.vehicle.Send(flight.now(), command);
    flight.Fly(1);
    return flight.vehicle.input().speed_m_s;
  };
  EXPECT_EQ(speed_input_after(CommandSpeed(60, 5)), 60);
  EXPECT_EQ(speed_input_after(CommandSpeed(61, 4)), 60);
  EXPECT_EQ(speed_input_after(CommandSpeed(62, 5)), 60);
  EXPECT_EQ(speed_input_after(CommandSpeed(63, 100, 9)), 60);
  EXPECT_EQ(speed_input_after(CommandSpeed(64, 1, 11)), 60) << "its own still commands";
  EXPECT_EQ(speed_input_after(CommandSpeed(64, 5'000'000, 10)), 60) << "nothing explains such a jump";
  flight.Fly(10);
  EXPECT_EQ(speed_input_after(CommandSpeed(64, 1, 11)), 64) << "a controller that was started anew";
  EXPECT_EQ(speed_input_after(CommandSpeed(65, 200, 10)), 64);
  EXPECT_EQ(flight.vehicle.Telemetry()->command_session_id, 11);
  EXPECT_EQ(flight.vehicle.Telemetry()->command_sequence, 1);
  flight.Fly(10);
  EXPECT_EQ(speed_input_after(CommandSpeed(66, 5000, 11)), 66) << "its uplink was gone for long";
}

TEST(SimulatedVehicle, KeepsTheNewestCommandWhenAJitteredLinkTurnsThemRound) {
  config::VehicleConfig config = Config();
  config.uplink.jitter_s = 0.5;
  Flight flight(config);
  std::int64_t sequence = 0;
  std::int64_t obeyed = 0;
  flight.Fly(400, [&] {
    ++sequence;
    flight.vehicle.Send(flight.now(), CommandSpeed(static_cast<double>(sequence), sequence));
    EXPECT_GE(flight.vehicle.Telemetry()->command_sequence, obeyed);
    obeyed = flight.vehicle.Telemetry()->command_sequence;
  });
  flight.Fly(10);
  EXPECT_EQ(flight.vehicle.Telemetry()->command_sequence, 400);
}

TEST(SimulatedVehicle, HoldsLevelOneSecondAfterItsUplinkFellSilent) {
  Flight flight(Config());
  std::int64_t sequence = 0;
  flight.Fly(100, [&] { flight.vehicle.Send(flight.now(), {FlightCommand{10, ++sequence, {80, 2, 0.2}}}); });
  flight.Fly(18);
  EXPECT_EQ(flight.vehicle.input().climb_rad, 0.2);  // 0.95 s
  flight.Fly(2);
  const VehicleState held = flight.vehicle.state();
  EXPECT_NEAR(flight.vehicle.input().speed_m_s, held.speed_m_s, 0.02);
  EXPECT_EQ(flight.vehicle.input().climb_rad, 0);
  flight.Fly(2000);
  EXPECT_NEAR(flight.vehicle.state().speed_m_s, held.speed_m_s, 0.02);
  EXPECT_NEAR(flight.vehicle.state().course_rad, held.course_rad, 0.01);
  EXPECT_NEAR(flight.vehicle.state().climb_rad, 0, 1e-3);
}

TEST(SimulatedVehicle, KeepsItsLastCommandWhenToldSo) {
  config::VehicleConfig config = Config();
  config.uplink_loss = config::UplinkLoss::kKeepLastCommand;
  Flight flight(config);
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.Fly(2000);
  EXPECT_EQ(flight.vehicle.input().speed_m_s, 60);
}

TEST(SimulatedVehicle, ObeysAgainAfterHolding) {
  Flight flight(Config());
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.Fly(100);
  flight.vehicle.Send(flight.now(), CommandSpeed(70, 2));
  flight.Fly(1);
  EXPECT_EQ(flight.vehicle.input().speed_m_s, 70);
}

TEST(SimulatedVehicle, FliesWithItsActualGainsNotWithTheOnesThatTheStationBelieves) {
  config::VehicleConfig config = Config();
  config.uplink_loss = config::UplinkLoss::kKeepLastCommand;
  config.actual = AutopilotGains{.speed_per_s = 0.02};
  Flight flight(config);
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.Fly(200);
  EXPECT_NEAR(flight.vehicle.state().speed_m_s, 60 - 10 * std::exp(-0.02 * 10), 1e-9);
}

TEST(SimulatedVehicle, ASilentDownlinkIsNotHeardAndAFrozenOneRepeatsItself) {
  Flight flight(Config());
  flight.Fly(10);
  const auto last = flight.vehicle.Telemetry();
  flight.vehicle.SetDownlink({LinkMode::kSilent, {}});
  flight.Fly(10);
  EXPECT_FALSE(flight.vehicle.Telemetry());
  flight.vehicle.SetDownlink({LinkMode::kFrozen, {}});
  flight.Fly(10);
  ASSERT_TRUE(flight.vehicle.Telemetry());
  EXPECT_EQ(flight.vehicle.Telemetry()->utime, last->utime);
  EXPECT_EQ(flight.vehicle.Telemetry()->north_m, last->north_m);
  flight.vehicle.SetDownlink({});
  EXPECT_EQ(flight.vehicle.Telemetry()->utime, flight.now());
}

TEST(SimulatedVehicle, AFrozenDownlinkThatWasNeverHeardIsSilent) {
  Flight flight(Config());
  flight.vehicle.SetDownlink({LinkMode::kFrozen, {}});
  EXPECT_FALSE(flight.vehicle.Telemetry());
}

TEST(SimulatedVehicle, ADelayedDownlinkBringsOldStatesWithTheirOwnTime) {
  config::VehicleConfig config = Config();
  config.downlink.delay_s = 0.2;
  Flight flight(config);
  for (int tick = 0; tick < 4; ++tick) {
    EXPECT_FALSE(flight.vehicle.Telemetry()) << tick;
    flight.Fly(1);
  }
  const auto report = flight.vehicle.Telemetry();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->utime, kStart);
  EXPECT_NEAR(report->north_m, 200, 1e-9);
}

TEST(SimulatedVehicle, ADelayedCommandIsFlownFromTheStepInWhichItArrives) {
  config::VehicleConfig config = Config();
  config.uplink.delay_s = 0.2;
  Flight flight(config);
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.Fly(4);  // it arrives at the end of the fourth step
  EXPECT_EQ(flight.vehicle.state().speed_m_s, 50);
  flight.Fly(1);
  EXPECT_GT(flight.vehicle.state().speed_m_s, 50);
}

TEST(SimulatedVehicle, TellsTheNewestOfSeveralStatesThatArriveTogether) {
  Flight flight(Config());
  const auto send_with_delay = [&](double delay_s) {
    flight.vehicle.SetDownlink({LinkMode::kUp, {.delay_s = delay_s}});
    const auto heard = flight.vehicle.Telemetry();
    flight.Fly(1);
    return heard;
  };
  EXPECT_FALSE(send_with_delay(0.1));   // of tick 0, arrives at 100 ms
  EXPECT_FALSE(send_with_delay(0.04));  // of tick 1, arrives at 90 ms
  const auto heard = send_with_delay(1);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->utime, kStart + kTick);
}

TEST(SimulatedVehicle, ACutUplinkStopsCommandsAndPayloadSwitches) {
  Flight flight(Config());
  flight.vehicle.SetUplink({LinkMode::kSilent, {}});
  flight.vehicle.Send(flight.now(), CommandSpeed(60, 1));
  flight.vehicle.Send(flight.now(), PayloadSwitch{true});
  flight.Fly(10);
  EXPECT_EQ(flight.vehicle.input().speed_m_s, 50);
  EXPECT_FALSE(flight.vehicle.payload_on());
  flight.vehicle.SetUplink({});
  flight.vehicle.Send(flight.now(), PayloadSwitch{true});
  flight.Fly(1);
  EXPECT_TRUE(flight.vehicle.payload_on());
  EXPECT_TRUE(flight.vehicle.Telemetry()->payload_on);
}

TEST(SimulatedVehicle, LosesDifferentMessagesUpAndDownAndOnEachVehicle) {
  const auto heard = [](int id, std::uint64_t seed) {
    config::VehicleConfig config = Config();
    config.id = id;
    config.downlink.loss = 0.5;
    Flight flight(config, seed);
    std::string pattern;
    flight.Fly(64, [&] { pattern += flight.vehicle.Telemetry() ? 'x' : '.'; });
    return pattern;
  };
  EXPECT_EQ(heard(3, 1), heard(3, 1));
  EXPECT_NE(heard(3, 1), heard(4, 1));
  EXPECT_NE(heard(3, 1), heard(3, 2));
}

}  // namespace
}  // namespace skein::simulator

// A thousand UAVs at 20 Hz over real multicast: nothing may be lost.

#include <gtest/gtest.h>

#include <thread>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/live_executor.h"
#include "bus/transport.h"

namespace skein::bus {
namespace {

constexpr int kVehicles = 1000;
constexpr int kTicks = 100;
constexpr Utime kTick = 50'000;
constexpr const char* kUrl = "udpm://239.255.76.67:7689?ttl=0";

fleet_command_t CommandFor(const fleet_state_t& state) {
  fleet_command_t command;
  command.utime = state.utime;
  command.session_id = 2;
  command.state_tick = state.tick;
  for (const auto& vehicle : state.vehicles) {
    command.commands.emplace_back();
    command.commands.back().id = vehicle.id;
  }
  return command;
}

/// Answers every FLEET_STATE until the last tick has come, or for a long time.
struct Controller {
  int whole_ticks = 0;
  std::int64_t gaps = 0;

  void Run() {
    const auto transport = MakeTransport(kUrl).lcm;
    LiveExecutor executor(transport);
    Bus bus(transport, "controller", executor);
    SubscribeChunks<fleet_state_t>(bus, channel::kFleetState, [&](const fleet_state_t& state, int missing) {
      whole_ticks += missing == 0 && state.num_vehicles == kVehicles ? 1 : 0;
      PublishChunks(bus, channel::kCmdFleet, CommandFor(state));
      if (state.tick == kTicks - 1) executor.Stop();
    });
    executor.At(executor.Now() + 30 * kSecond, [&] { executor.Stop(); });
    executor.Run();
    gaps = bus.statistics().gaps;
  }
};

TEST(AThousandUavs, LoseNothingAtTwentyHertz) {
  Controller controller;
  std::thread thread([&] { controller.Run(); });

  const auto transport = MakeTransport(kUrl).lcm;
  LiveExecutor executor(transport);
  Bus bus(transport, "simulator", executor);
  int answered = 0;
  SubscribeChunks<fleet_command_t>(bus, channel::kCmdFleet, [&](const fleet_command_t& command, int missing) {
    answered += missing == 0 && command.num_commands == kVehicles ? 1 : 0;
    if (command.state_tick == kTicks - 1) executor.Stop();
  });
  fleet_state_t state;
  state.session_id = 1;
  state.vehicles.resize(kVehicles);
  for (int i = 0; i < kVehicles; ++i) state.vehicles[static_cast<std::size_t>(i)].id = i + 1;
  const Utime start = executor.Now() + kSecond;  // by then the other side listens
  executor.Every(kTick, [&] {
    if (executor.Now() < start || state.tick == kTicks) return;
    state.utime = executor.Now();
    PublishChunks(bus, channel::kFleetState, state);
    ++state.tick;
  });
  executor.At(start + 30 * kSecond, [&] { executor.Stop(); });
  executor.Run();
  thread.join();

  EXPECT_EQ(controller.whole_ticks, kTicks);
  EXPECT_EQ(controller.gaps, 0);
  EXPECT_EQ(answered, kTicks);
  EXPECT_EQ(bus.statistics().gaps, 0);
}

}  // namespace
}  // namespace skein::bus

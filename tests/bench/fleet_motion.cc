// Fleet integration on one core: FleetMotion, and what it is measured against, Step() for one UAV after the
// other.
#include "core/fleet_motion.h"

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace skein {
namespace {

constexpr double kStep_s = 0.05;

struct Uav {
  VehicleState state;
  AutopilotInput input;
};

/// All the time turning, climbing and changing speed, within the default envelope and at its limits.
std::vector<Uav> RandomFleet(std::int64_t count) {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Uav> fleet;
  for (std::int64_t i = 0; i < count; ++i) {
    fleet.push_back({{between(-1e5, 1e5), between(-1e5, 1e5), 1000, between(30, 90), between(-3, 3),
                      between(-0.35, 0.35)},
                     {between(0, 120), between(-3, 3), between(-0.5, 0.5)}});
  }
  return fleet;
}

void OneByOne(benchmark::State& state) {
  std::vector<Uav> fleet = RandomFleet(state.range(0));
  const VehicleModel model;
  for (auto _ : state) {
    for (Uav& uav : fleet) uav.state = Step(uav.state, uav.input, model, kStep_s);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void Together(benchmark::State& state) {
  FleetMotion fleet;
  for (const Uav& uav : RandomFleet(state.range(0))) fleet.Add(uav.state, uav.input, VehicleModel());
  for (auto _ : state) {
    fleet.Step(kStep_s);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(OneByOne)->Arg(3)->Arg(1000)->Arg(100000);
BENCHMARK(Together)->Arg(3)->Arg(1000)->Arg(100000);

}  // namespace
}  // namespace skein

BENCHMARK_MAIN();

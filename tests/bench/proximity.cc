// Nearest UAV and least Tau of everybody, exactly: the search, and what it is measured against, all pairs
// several at once.
#include "core/proximity.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "bench/all_pairs.h"

namespace skein {
namespace {

constexpr int kMembers = 100;
constexpr double kSpacing_m = 50;

/// A fleet and the thresholds that go with it: formations of UAVs 50 m apart set their own R and H.
struct Airspace {
  std::vector<Traffic> fleet;
  ProximityRules rules;
};

class Random {
 public:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Vector3d Velocity(double speed_m_s) {
    const double course_rad = Between(-std::numbers::pi, std::numbers::pi);
    return {speed_m_s * std::cos(course_rad), speed_m_s * std::sin(course_rad), 0};
  }

 private:
  std::mt19937 random_{1};
};

/// One UAV a square kilometre, each on a course of its own.
Airspace Uniform(int count) {
  Random random;
  Airspace air;
  const double side_m = 1000 * std::sqrt(count);
  for (int id = 1; id <= count; ++id) {
    air.fleet.push_back({id,
                         {random.Between(0, side_m), random.Between(0, side_m), random.Between(500, 3000)},
                         random.Velocity(random.Between(40, 60))});
  }
  return air;
}

/// A square of `count` from a corner on, everybody at the same velocity but for what a law corrects.
void AddFormation(Airspace& air, Random& random, int formation_id, int count, const Eigen::Vector3d& corner,
                  const Eigen::Vector3d& velocity) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d place(kSpacing_m * (i % side), kSpacing_m * (i / side), 0);
    const Eigen::Vector3d correction(random.Between(-1, 1), random.Between(-1, 1), random.Between(-0.5, 0.5));
    air.fleet.push_back(
        {static_cast<int>(air.fleet.size()) + 1, corner + place, velocity + correction, formation_id});
  }
  ProximityLimits limits;
  limits.radius_m = limits.d_mod_m = 20;
  limits.height_m = 10;
  air.rules.formations[formation_id] = limits;
}

/// Nine in ten in formations of 100, the others by themselves, one a square kilometre over all.
Airspace FormationsAt(int count, double speed_m_s) {
  Airspace air = Uniform(count / 10);
  Random random;
  const double side_m = 1000 * std::sqrt(count);
  for (Traffic& uav : air.fleet) uav.position.head<2>() *= std::sqrt(10);
  for (int id = 1; id <= count * 9 / 10 / kMembers; ++id) {
    const Eigen::Vector3d corner(random.Between(0, side_m), random.Between(0, side_m),
                                 random.Between(500, 3000));
    AddFormation(air, random, id, kMembers, corner, random.Velocity(speed_m_s));
  }
  return air;
}

Airspace OneFormation(int count) {
  Airspace air;
  Random random;
  AddFormation(air, random, 1, count, {0, 0, 1000}, {0, 50, 0});
  return air;
}

void Search(benchmark::State& state, Airspace (*make)(int)) {
  const Airspace air = make(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(FindProximity(air.fleet, air.rules));
}

void Pairs(benchmark::State& state) {
  const Airspace air = Uniform(static_cast<int>(state.range(0)));
  const bench::AllPairs pairs(air.fleet, air.rules.strangers);
  for (auto _ : state) benchmark::DoNotOptimize(pairs.Sum());
}

Airspace Formations(int count) { return FormationsAt(count, 50); }
Airspace Crossing(int count) { return FormationsAt(count, 100); }

BENCHMARK_CAPTURE(Search, uniform, Uniform)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(Search, formations, Formations)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(Search, crossing, Crossing)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(Search, one_formation, OneFormation)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(Pairs)->Arg(10000)->Arg(100000)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace skein

BENCHMARK_MAIN();

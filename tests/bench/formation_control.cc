// Formation control on one core, one tick: the slot and the command of every UAV, formations of 100 on a path
// with turns.
#include <benchmark/benchmark.h>

#include <stdexcept>
#include <vector>

#include "core/formation.h"
#include "core/path.h"
#include "core/skein_law.h"
#include "core/slot_reference.h"

namespace skein {
namespace {

constexpr int kMembers = 100;
constexpr double kStep_s = 0.05;

Path Round() {
  PathLimits limits;
  limits.most_left_m = limits.most_right_m = 700;
  limits.hindmost_m = -2000;
  const std::vector<Waypoint> corners = {
      {0, 0, 1000, 50}, {0, 30000, 1200, 55}, {30000, 30000, 1000, 50}, {30000, 0, 900, 50}};
  const PathResult planned = PlanWaypoints(corners, true, limits);
  if (!planned.path) throw std::runtime_error(planned.reason);
  return *planned.path;
}

void OneTick(benchmark::State& state) {
  const Path path = Round();
  const std::vector<SlotOffset> slots = ShapeSlots(Shape::kTriangle, kMembers, 100);
  const auto count = static_cast<std::size_t>(state.range(0));
  const VehicleModel model;
  const auto arc_of = [&](std::size_t uav) { return 137.0 * static_cast<double>(uav / kMembers); };
  std::vector<SkeinLaw> laws(count);
  std::vector<VehicleState> states(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SlotReference slot = SlotOnPath(path, arc_of(i), slots[i % kMembers], {});
    // A little beside its slot: all parts of the law have something to do.
    states[i] = {slot.position.x() + 5, slot.position.y() - 3, slot.position.z() + 2,
                 slot.speed_m_s,        slot.course_rad,       0};
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) {
      const SlotReference slot = SlotOnPath(path, arc_of(i), slots[i % kMembers], {});
      benchmark::DoNotOptimize(laws[i].Control(slot, states[i], model, kStep_s));
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(OneTick)->RangeMultiplier(10)->Range(100, 100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein

BENCHMARK_MAIN();

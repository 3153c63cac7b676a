#include "cli/drop_schedule.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string>
#include <utility>

#include "cli/vehicles.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

std::function<std::optional<Drop>()> FromList(std::vector<Drop> drops, double repeat_s) {
  return [drops = std::move(drops), repeat_s, index = std::size_t{0},
          round = 0]() mutable -> std::optional<Drop> {
    if (index == drops.size()) {
      if (repeat_s <= 0) return std::nullopt;
      index = 0;
      ++round;
    }
    Drop drop = drops[index++];
    drop.at_s += round * repeat_s;
    return drop;
  };
}

std::function<std::optional<Drop>()> FromRandom(RandomPlan plan, int count) {
  return [plan = std::move(plan), count, made = 0]() mutable -> std::optional<Drop> {
    return count > 0 && made++ >= count ? std::nullopt : std::optional(plan.Next());
  };
}

std::vector<int> AllVehicles(Station& station) {
  std::vector<int> ids;
  for (const auto& vehicle : station.Roster().vehicles) ids.push_back(vehicle.id);
  return ids;
}

std::vector<Drop> FromOptions(const DropsOptions& options) {
  std::vector<Drop> drops;
  for (const std::string& vehicle : options.vehicles) {
    Drop drop{.at_s = std::max(0.0, options.at_s), .vehicle = vehicle, .for_s = options.for_s};
    SetDirection(drop, options.direction, "--direction");
    drop.delay_s = options.delay_s;
    drop.loss = options.loss >= 0 ? options.loss : options.delay_s > 0 ? 0 : 1;
    drops.push_back(drop);
  }
  return drops;
}

}  // namespace

std::vector<int> VehiclesOf(Station& station, const Drop& drop, const DropsOptions& options) {
  if (drop.vehicle == "all") return AllVehicles(station);
  if (drop.vehicle == "none" && !options.hook.empty()) return {};
  return FindVehicles(station, {drop.vehicle});
}

DropSchedule MakeSchedule(Station& station, const DropsOptions& options, bus::Utime lead) {
  const bus::Utime scenario_start = station.Roster().start_utime;
  const bus::Utime now = station.bus().executor().Now();
  if (options.random) {
    const auto& names = options.vehicles;
    const bool all = names.empty() || std::find(names.begin(), names.end(), "all") != names.end();
    std::vector<int> vehicles = all ? AllVehicles(station) : FindVehicles(station, names);
    if (vehicles.empty()) throw Failure("there are no UAVs");
    return {now + lead, FromRandom(RandomPlan(options.random_drops, std::move(vehicles)), options.count)};
  }
  const bool is_list = !options.file.empty();
  std::vector<Drop> drops = is_list ? options.list : FromOptions(options);
  const double span_s = drops.back().at_s - drops.front().at_s;
  if (options.repeat_s > 0 && options.repeat_s <= span_s) {
    throw config::ConfigError(fmt::format(
        "--repeat: must be more than the {:g} s from the first drop of the list to its last one, is {:g}",
        span_s, options.repeat_s));
  }
  for (const Drop& drop : drops) VehiclesOf(station, drop, options);
  const bool of_scenario = is_list ? !options.from_now : options.at_s >= 0;
  DropSchedule schedule{of_scenario ? scenario_start : now + lead, {}};
  // Without a lead, what is to begin now is a moment late by now.
  if (of_scenario && schedule.StartOf(drops.front()) < now) {
    throw Failure(fmt::format("{:g} s of the scenario have passed: it is {:.0f} s{}", drops.front().at_s,
                              bus::ToSeconds(now - scenario_start),
                              is_list ? "; --from-now counts from now" : ""));
  }
  schedule.next = FromList(std::move(drops), options.repeat_s);
  return schedule;
}

}  // namespace skein::cli

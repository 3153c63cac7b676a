#include "system/flight_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::testing {
namespace {

struct Place {
  double east_m, north_m, up_m;
};

/// Where the curve is at `t_s`, between two of its states in a straight line; none outside of it.
std::optional<Place> At(const std::vector<StateAt>& curve, double t_s) {
  const auto after = std::lower_bound(curve.begin(), curve.end(), t_s,
                                      [](const StateAt& item, double t) { return item.t_s < t; });
  if (after == curve.end() || (after == curve.begin() && after->t_s > t_s)) return std::nullopt;
  const auto before = after == curve.begin() ? after : after - 1;
  const double span_s = after->t_s - before->t_s;
  const double part = span_s > 0 ? (t_s - before->t_s) / span_s : 0;
  const auto between = [&](double vehicle_state_t::*field) {
    return std::lerp(before->state.*field, after->state.*field, part);
  };
  return Place{between(&vehicle_state_t::east_m), between(&vehicle_state_t::north_m),
               between(&vehicle_state_t::up_m)};
}

}  // namespace

FlightLog ReadFlightLog(const std::string& file) {
  FlightLog log;
  std::vector<fleet_state_t> states;
  std::optional<std::int64_t> start_utime;
  const bus::Transport transport = bus::MakeTransport("file://" + file + "?speed=0");
  bus::SimulatedExecutor executor(transport.lcm);
  bus::Bus reader(transport.lcm, "system-test", executor);
  reader.Subscribe<fleet_roster_t>(bus::channel::kFleetRoster,
                                   [&](const fleet_roster_t& roster) { start_utime = roster.start_utime; });
  reader.Subscribe<fleet_state_t>(bus::channel::kFleetState,
                                  [&](const fleet_state_t& state) { states.push_back(state); });
  reader.Subscribe<event_t>(bus::channel::kEvent, [&](const event_t& event) {
    log.events.push_back({0, event});
  });
  while (transport.lcm->handle() == 0) {
  }
  const auto since_start = [&](std::int64_t utime) { return bus::ToSeconds(utime - start_utime.value()); };
  for (const fleet_state_t& state : states) {
    for (const vehicle_state_t& vehicle : state.vehicles) {
      log.curves[vehicle.id].push_back({since_start(vehicle.utime), vehicle});
    }
  }
  for (EventAt& item : log.events) item.t_s = since_start(item.event.utime);
  return log;
}

double GreatestDistance(const std::vector<StateAt>& reference, const std::vector<StateAt>& other,
                        double end_s) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (other.empty() || other.back().t_s < end_s) return kNever;
  double greatest_m = 0;
  for (const StateAt& item : other) {
    if (item.t_s > end_s) break;
    const auto place = At(reference, item.t_s);
    if (!place) return kNever;
    const double distance_m = std::hypot(item.state.east_m - place->east_m,
                                         item.state.north_m - place->north_m, item.state.up_m - place->up_m);
    greatest_m = std::max(greatest_m, distance_m);
  }
  return greatest_m;
}

}  // namespace skein::testing

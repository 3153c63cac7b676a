#include "experiment/flight_sampler.h"

#include <utility>

namespace skein::experiment {
namespace {

constexpr std::int64_t kTicksPerSample = 4;

}  // namespace

FlightSampler::FlightSampler(const config::Scenario& scenario, std::string label) {
  record_.label = std::move(label);
  for (const auto& vehicle : scenario.vehicles) {
    record_.vehicles.emplace_back();
    record_.vehicles.back().id = vehicle.id;
    record_.vehicles.back().callsign = vehicle.callsign;
  }
  cut_.resize(record_.vehicles.size());
}

void FlightSampler::Add(const Tick& tick) {
  for (std::size_t i = 0; i < tick.vehicles.size(); ++i) {
    const VehicleTick& vehicle = tick.vehicles[i];
    const bool cut = vehicle.uplink_cut || vehicle.downlink_cut;
    if (cut != cut_[i]) record_.link_changes_s.push_back(tick.t_s);
    cut_[i] = cut;
    if (tick.number % kTicksPerSample != 0) continue;
    plot::VehicleRecord& record = record_.vehicles[i];
    record.t_s.push_back(tick.t_s);
    record.east_m.push_back(vehicle.truth.east_m);
    record.north_m.push_back(vehicle.truth.north_m);
    record.up_m.push_back(vehicle.truth.up_m);
    record.speed_m_s.push_back(vehicle.truth.speed_m_s);
    if (!vehicle.slot) continue;
    record.slot_t_s.push_back(tick.t_s);
    record.forward_error_m.push_back(vehicle.slot->forward_error_m);
    record.left_error_m.push_back(vehicle.slot->left_error_m);
    record.up_error_m.push_back(vehicle.slot->up_error_m);
  }
}

}  // namespace skein::experiment

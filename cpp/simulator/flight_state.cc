#include "simulator/flight_state.h"

#include <skein/fleet_state_t.hpp>
#include <utility>

#include "bus/chunks.h"
#include "bus/saved_bytes.h"

namespace skein::simulator {
namespace {

void Add(bus::SavedBytes& bytes, const std::vector<SimulatedVehicle::Memory>& vehicles) {
  fleet_state_t reports{};
  for (const auto& vehicle : vehicles) reports.vehicles.push_back(vehicle.report);
  const std::vector<fleet_state_t> chunks = bus::Split(reports);
  bytes.Add(static_cast<std::int64_t>(chunks.size()));
  for (const fleet_state_t& chunk : chunks) bytes.Add(chunk);
  for (const auto& vehicle : vehicles) {
    bytes.Add(vehicle.input.speed_m_s);
    bytes.Add(vehicle.input.course_rad);
    bytes.Add(vehicle.input.climb_rad);
    bytes.Add(vehicle.commanded.value_or(0));
  }
}

bool Take(bus::SavedReader& reader, std::vector<SimulatedVehicle::Memory>& vehicles) {
  const auto chunks = reader.Number();
  for (std::int64_t i = 0; i < chunks.value_or(0); ++i) {
    const auto chunk = reader.Take<fleet_state_t>();
    if (!chunk) return false;
    for (const vehicle_state_t& report : chunk->vehicles) vehicles.push_back({report, {}, std::nullopt});
  }
  for (SimulatedVehicle::Memory& vehicle : vehicles) {
    const auto speed_m_s = reader.Real();
    const auto course_rad = reader.Real();
    const auto climb_rad = reader.Real();
    const auto commanded = reader.Number();
    if (!commanded) return false;
    vehicle.input = {*speed_m_s, *course_rad, *climb_rad};
    if (*commanded != 0) vehicle.commanded = *commanded;
  }
  return chunks.has_value();
}

}  // namespace

std::string Encode(const FlightState& state) {
  bus::SavedBytes bytes;
  bytes.Add(state.started_with);
  bytes.Add(state.scenario);
  bytes.Add(static_cast<std::int64_t>(state.seed));
  bytes.Add(state.start_utime);
  bytes.Add(state.tick);
  bytes.Add(static_cast<std::int64_t>(state.link_orders.size()));
  for (const LinkOrder& order : state.link_orders) {
    bytes.Add(order.utime);
    bytes.Add(order.command);
  }
  Add(bytes, state.vehicles);
  return bytes.Take();
}

std::optional<FlightState> DecodeFlightState(std::string_view bytes) {
  bus::SavedReader reader(bytes);
  const auto started_with = reader.Text();
  const auto scenario = reader.Text();
  const auto seed = reader.Number();
  const auto start_utime = reader.Number();
  const auto tick = reader.Number();
  const auto orders = reader.Number();
  if (!orders) return std::nullopt;
  FlightState state{std::string(*started_with),
                    std::string(*scenario),
                    static_cast<std::uint64_t>(*seed),
                    *start_utime,
                    *tick,
                    {},
                    {}};
  for (std::int64_t i = 0; i < *orders; ++i) {
    const auto utime = reader.Number();
    auto command = reader.Take<link_command_t>();
    if (!utime || !command) return std::nullopt;
    state.link_orders.push_back({*utime, std::move(*command)});
  }
  if (!Take(reader, state.vehicles)) return std::nullopt;
  return state;
}

}  // namespace skein::simulator

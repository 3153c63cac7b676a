#include "controller/controller_state.h"

#include <utility>

#include "bus/saved_bytes.h"

namespace skein::controller {

std::string Encode(const ControllerState& state) {
  bus::SavedBytes bytes;
  bytes.Add(state.start_utime);
  bytes.Add(static_cast<std::int64_t>(state.formations.size()));
  for (const FormationState& formation : state.formations) {
    bytes.Add(formation.formation);
    bytes.Add(formation.path);
    bytes.Add(formation.status);
    bytes.Add(static_cast<std::int64_t>(formation.path_before_hold.has_value()));
    if (formation.path_before_hold) {
      bytes.Add(*formation.path_before_hold);
      bytes.Add(formation.arc_before_hold_m);
    }
  }
  bytes.Add(state.heard);
  bytes.Add(static_cast<std::int64_t>(state.lost.size()));
  for (const int id : state.lost) bytes.Add(static_cast<std::int64_t>(id));
  return bytes.Take();
}

std::optional<ControllerState> DecodeControllerState(std::string_view bytes) {
  bus::SavedReader reader(bytes);
  const auto start_utime = reader.Number();
  const auto count = reader.Number();
  if (!start_utime || !count) return std::nullopt;
  ControllerState state;
  state.start_utime = *start_utime;
  for (std::int64_t i = 0; i < *count; ++i) {
    auto formation = reader.Take<formation_t>();
    auto path = reader.Take<path_t>();
    auto status = reader.Take<formation_status_t>();
    const auto holds = reader.Number();
    if (!formation || !path || !status || !holds) return std::nullopt;
    FormationState saved{std::move(*formation), std::move(*path), std::move(*status), std::nullopt, 0};
    if (*holds != 0) {
      saved.path_before_hold = reader.Take<path_t>();
      const auto arc = reader.Real();
      if (!saved.path_before_hold || !arc) return std::nullopt;
      saved.arc_before_hold_m = *arc;
    }
    state.formations.push_back(std::move(saved));
  }
  auto heard = reader.Take<fleet_state_t>();
  const auto lost = reader.Number();
  if (!heard || !lost) return std::nullopt;
  state.heard = std::move(*heard);
  for (std::int64_t i = 0; i < *lost; ++i) {
    const auto id = reader.Number();
    if (!id) return std::nullopt;
    state.lost.push_back(static_cast<int>(*id));
  }
  return state;
}

}  // namespace skein::controller

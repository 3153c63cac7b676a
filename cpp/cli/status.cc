#include "cli/status.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/text_table.h"
#include "cli/vehicles.h"
#include "core/frames.h"

namespace skein::cli {
namespace {

constexpr std::array<std::string_view, 4> kLevels = {"clear", "advisory", "caution", "WARNING"};
constexpr std::array<std::string_view, 4> kLinks = {"up", "late", "LOST", "unknown"};
constexpr std::array<std::string_view, 4> kLinkNames = {"up", "late", "lost", "unknown"};
constexpr std::array<std::string_view, 6> kModes = {"assembling", "in formation", "avoiding",
                                                    "rejoining",  "holding",      "waiting"};

/// What is known of one UAV; null where nothing is.
struct Row {
  std::string callsign;
  int formation_id = 0;
  const vehicle_state_t* state = nullptr;
  const vehicle_proximity_t* proximity = nullptr;
  const vehicle_link_t* link = nullptr;
  const slot_status_t* slot = nullptr;
};

std::map<int, Row> Rows(const Picture& picture) {
  std::map<int, Row> rows;
  if (picture.roster) {
    for (const auto& info : picture.roster->vehicles) rows[info.id].callsign = info.callsign;
  }
  if (picture.state) {
    for (const auto& state : picture.state->vehicles) rows[state.id].state = &state;
  }
  if (picture.proximity) {
    for (const auto& proximity : picture.proximity->vehicles) rows[proximity.id].proximity = &proximity;
  }
  if (picture.links) {
    for (const auto& link : picture.links->links) rows[link.id].link = &link;
  }
  for (const auto& [formation_id, status] : picture.statuses) {
    for (const auto& slot : status.slots) {
      rows[slot.vehicle_id].slot = &slot;
      rows[slot.vehicle_id].formation_id = formation_id;
    }
  }
  return rows;
}

/// One word when both directions agree (an uplink that is not judged agrees), else the directions that are
/// not up.
std::string LinkText(const vehicle_link_t& link) {
  const auto state = [](std::int8_t number) { return kLinks.at(static_cast<std::size_t>(number)); };
  if (link.downlink == link.uplink || link.uplink == link_status_t::LINK_UNKNOWN)
    return std::string(state(link.downlink));
  std::string text;
  if (link.downlink != link_status_t::LINK_UP) text = fmt::format("down {}", state(link.downlink));
  if (link.uplink != link_status_t::LINK_UP)
    text += fmt::format("{}up {}", text.empty() ? "" : ", ", state(link.uplink));
  return text;
}

std::vector<std::string> Cells(int id, const Row& row, const Picture& picture) {
  const auto name = [&](int vehicle_id) { return vehicle_id > 0 ? Callsign(picture, vehicle_id) : "-"; };
  std::vector<std::string> cells = {row.callsign.empty() ? std::to_string(id) : row.callsign};
  cells.emplace_back(row.proximity ? kLevels.at(static_cast<std::size_t>(row.proximity->level)) : "-");
  cells.emplace_back(row.link ? LinkText(*row.link) : "-");
  cells.emplace_back(row.slot ? fmt::format("{:.1f} / {:.1f} / {:.1f}", row.slot->forward_error_m,
                                            row.slot->left_error_m, row.slot->up_error_m)
                              : "-");
  const bool near = row.proximity && row.proximity->nearest_id > 0;
  cells.emplace_back(near ? name(row.proximity->nearest_id) : "-");
  cells.emplace_back(near ? fmt::format("{:.0f}", row.proximity->nearest_horizontal_m) : "-");
  cells.emplace_back(near ? fmt::format("{:.0f}", row.proximity->nearest_vertical_m) : "-");
  const bool closes = row.proximity && row.proximity->tau_id > 0;
  cells.emplace_back(closes ? fmt::format("{} {:.0f}", name(row.proximity->tau_id), row.proximity->tau_s)
                            : "-");
  cells.emplace_back(row.state ? fmt::format("{:.0f}", row.state->up_m) : "-");
  cells.emplace_back(row.state ? fmt::format("{:.1f}", row.state->speed_m_s) : "-");
  cells.emplace_back(row.state ? fmt::format("{:03.0f}", CompassDegrees(row.state->course_rad)) : "-");
  cells.emplace_back(!row.state ? "-" : row.state->payload_on ? "on" : "off");
  return cells;
}

template <typename Part, typename Value>
nlohmann::ordered_json OrNull(const Part* part, Value Part::*member) {
  return part ? nlohmann::ordered_json(part->*member) : nlohmann::ordered_json(nullptr);
}

}  // namespace

std::string StatusTable(const Picture& picture) {
  Table table = {{"UAV", "level", "link", "error f / l / u, m", "nearest", "R, m", "H, m", "Tau, s", "alt, m",
                  "speed, m/s", "course", "payload"}};
  for (const auto& [id, row] : Rows(picture)) table.push_back(Cells(id, row, picture));
  return Aligned(table, 3);
}

std::string StatusJson(const Picture& picture) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& [id, row] : Rows(picture)) {
    nlohmann::ordered_json json = {{"id", id}, {"callsign", nullptr}, {"formation_id", row.formation_id}};
    if (!row.callsign.empty()) json["callsign"] = row.callsign;
    json["level"] = OrNull(row.proximity, &vehicle_proximity_t::level);
    for (const auto& [name, member] :
         {std::pair("downlink", &vehicle_link_t::downlink), std::pair("uplink", &vehicle_link_t::uplink)}) {
      json[name] = nullptr;
      if (row.link) json[name] = kLinkNames.at(static_cast<std::size_t>(row.link->*member));
    }
    json["forward_error_m"] = OrNull(row.slot, &slot_status_t::forward_error_m);
    json["left_error_m"] = OrNull(row.slot, &slot_status_t::left_error_m);
    json["up_error_m"] = OrNull(row.slot, &slot_status_t::up_error_m);
    json["nearest_id"] = OrNull(row.proximity, &vehicle_proximity_t::nearest_id);
    json["nearest_horizontal_m"] = OrNull(row.proximity, &vehicle_proximity_t::nearest_horizontal_m);
    json["nearest_vertical_m"] = OrNull(row.proximity, &vehicle_proximity_t::nearest_vertical_m);
    json["tau_id"] = OrNull(row.proximity, &vehicle_proximity_t::tau_id);
    json["tau_s"] = OrNull(row.proximity, &vehicle_proximity_t::tau_s);
    json["east_m"] = OrNull(row.state, &vehicle_state_t::east_m);
    json["north_m"] = OrNull(row.state, &vehicle_state_t::north_m);
    json["up_m"] = OrNull(row.state, &vehicle_state_t::up_m);
    json["speed_m_s"] = OrNull(row.state, &vehicle_state_t::speed_m_s);
    json["course_deg"] = nullptr;
    if (row.state) json["course_deg"] = CompassDegrees(row.state->course_rad);
    json["payload_on"] = nullptr;
    if (row.state) json["payload_on"] = row.state->payload_on != 0;
    rows.push_back(std::move(json));
  }
  return rows.dump(1);
}

std::string FormationTable(const Picture& picture) {
  Table table = {{"formation", "name", "shape", "control", "UAVs", "mode"}};
  for (const auto& [id, formation] : picture.formations) {
    std::string members;
    for (const slot_t& slot : formation.slots) {
      members += (members.empty() ? "" : ", ") + Callsign(picture, slot.vehicle_id);
    }
    std::string mode = formation.hold ? "holding" : "-";
    if (const auto status = picture.statuses.find(id); status != picture.statuses.end()) {
      mode = std::string(kModes.at(static_cast<std::size_t>(status->second.mode)));
      const std::string& text = status->second.mode_text;
      mode = text.starts_with(mode) ? text : mode + (text.empty() ? "" : ": " + text);
    }
    table.push_back({std::to_string(id), formation.name, formation.shape, formation.control, members, mode});
  }
  return Aligned(table, 6);
}

}  // namespace skein::cli

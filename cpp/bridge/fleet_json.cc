#include "bridge/fleet_json.h"

namespace skein::bridge {
namespace {

const char* LinkName(std::int8_t state) {
  switch (state) {
    case link_status_t::LINK_UP:
      return "up";
    case link_status_t::LINK_LATE:
      return "late";
    case link_status_t::LINK_LOST:
      return "lost";
    default:
      return "unknown";
  }
}

Json Row(std::int32_t id, const recording::FleetRow& row, bus::Utime now) {
  Json result = {{"id", id}, {"formation_id", row.formation_id}};
  const auto add = [&result](const char* name, const auto& part, auto value) {
    result[name] = part ? Json(value(*part)) : Json(nullptr);
  };
  add("callsign", row.info, [](const auto& info) { return info.callsign; });
  add("model", row.info, [](const auto& info) { return info.model; });
  add("has_payload", row.info, [](const auto& info) { return info.has_payload != 0; });
  add("east_m", row.state, [](const auto& state) { return state.east_m; });
  add("north_m", row.state, [](const auto& state) { return state.north_m; });
  add("up_m", row.state, [](const auto& state) { return state.up_m; });
  add("speed_m_s", row.state, [](const auto& state) { return state.speed_m_s; });
  add("course_rad", row.state, [](const auto& state) { return state.course_rad; });
  add("climb_rad", row.state, [](const auto& state) { return state.climb_rad; });
  add("payload_on", row.state, [](const auto& state) { return state.payload_on != 0; });
  add("age_s", row.state, [&](const auto&) { return bus::ToSeconds(now - row.heard_at); });
  add("forward_error_m", row.slot, [](const auto& slot) { return slot.forward_error_m; });
  add("left_error_m", row.slot, [](const auto& slot) { return slot.left_error_m; });
  add("up_error_m", row.slot, [](const auto& slot) { return slot.up_error_m; });
  add("flown", row.slot, [](const auto& slot) { return slot.flown != 0; });
  add("level", row.proximity, [](const auto& near) { return int{near.level}; });
  add("level_with_id", row.proximity, [](const auto& near) { return near.level_with_id; });
  add("nearest_id", row.proximity, [](const auto& near) { return near.nearest_id; });
  add("nearest_horizontal_m", row.proximity, [](const auto& near) { return near.nearest_horizontal_m; });
  add("nearest_vertical_m", row.proximity, [](const auto& near) { return near.nearest_vertical_m; });
  add("tau_id", row.proximity, [](const auto& near) { return near.tau_id; });
  add("tau_s", row.proximity, [](const auto& near) { return near.tau_s; });
  add("downlink", row.link, [](const auto& link) { return LinkName(link.downlink); });
  add("uplink", row.link, [](const auto& link) { return LinkName(link.uplink); });
  add("downlink_age_s", row.link, [](const auto& link) { return link.downlink_age_s; });
  add("uplink_age_s", row.link, [](const auto& link) { return link.uplink_age_s; });
  return result;
}

}  // namespace

Json ToJson(const recording::FleetTable& fleet, bus::Utime now) {
  Json rows = Json::array();
  for (const auto& [id, row] : fleet.rows()) rows.push_back(Row(id, row, now));
  return rows;
}

}  // namespace skein::bridge

#pragma once

#include <nlohmann/json.hpp>
#include <skein/alarm_list_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <skein/path_t.hpp>
#include <skein/recording_status_t.hpp>
#include <string>

namespace skein::bridge {

/// Bus messages as the browsers get them: "type" first, then the names of the LCM fields.
/// Chunked ones are given whole, their chunks put together.
using Json = nlohmann::ordered_json;

Json ToJson(const fleet_roster_t& roster);
Json ToJson(const formation_t& formation);
Json ToJson(const formation_status_t& status);
Json ToJson(const event_t& event);
Json ToJson(const heartbeat_t& heartbeat);
Json ToJson(const alarm_list_t& list);
Json ToJson(const recording_status_t& status);
/// Without "line".
Json ToJson(const path_t& path);

/// What `convert` makes of each, as an array.
template <typename Items, typename Convert>
Json Each(const Items& items, Convert convert) {
  Json result = Json::array();
  for (const auto& item : items) result.push_back(convert(item));
  return result;
}

/// Text of it; bytes that are no UTF-8 (a stranger's callsign) become U+FFFD instead of an exception.
std::string Dump(const Json& json);

}  // namespace skein::bridge

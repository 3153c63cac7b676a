#pragma once

#include <nlohmann/json.hpp>
#include <skein/alarm_t.hpp>

namespace skein::bus {

/// One alarm as programs read it, whether from the bridge or from `skein alarms --json`: the names of the LCM
/// fields, in their order.
nlohmann::ordered_json ToJson(const alarm_t& alarm);

}  // namespace skein::bus

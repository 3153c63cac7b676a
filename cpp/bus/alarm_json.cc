#include "bus/alarm_json.h"

namespace skein::bus {

nlohmann::ordered_json ToJson(const alarm_t& alarm) {
  return {{"id", alarm.id},
          {"condition", alarm.condition},
          {"severity", alarm.severity},
          {"state", alarm.state},
          {"vehicle_id", alarm.vehicle_id},
          {"other_vehicle_id", alarm.other_vehicle_id},
          {"formation_id", alarm.formation_id},
          {"text", alarm.text},
          {"raised_utime", alarm.raised_utime},
          {"cleared_utime", alarm.cleared_utime},
          {"acknowledged_utime", alarm.acknowledged_utime},
          {"acknowledged_by", alarm.acknowledged_by},
          {"shelved_until_utime", alarm.shelved_until_utime},
          {"shelved_by", alarm.shelved_by}};
}

}  // namespace skein::bus

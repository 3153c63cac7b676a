#include "monitor/scenario_options.h"

namespace skein::monitor {

CollisionMonitorOptions OptionsOf(const config::Scenario& scenario) {
  CollisionMonitorOptions options;
  options.scenario = scenario.name;
  options.strangers = scenario.strangers;
  for (const config::FormationConfig& formation : scenario.formations) {
    KnownFormation& known = options.formations.emplace_back();
    known.id = formation.id;
    known.limits = formation.proximity;
    for (const Slot& slot : formation.slots) known.members.push_back(slot.vehicle_id);
  }
  return options;
}

}  // namespace skein::monitor

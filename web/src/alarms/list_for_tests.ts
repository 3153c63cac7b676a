/** Lists of alarms as the bridge sends them, for tests. */
import type { Alarm, AlarmList } from "../link/messages";

export function alarm(id: number, state: number, severity = 3, change: Partial<Alarm> = {}): Alarm {
  return {
    id,
    condition: `link:${id}`,
    severity,
    state,
    vehicle_id: id,
    other_vehicle_id: 0,
    formation_id: 0,
    text: `link of UAV${id} lost`,
    raised_utime: id * 1e6,
    cleared_utime: 0,
    acknowledged_utime: 0,
    acknowledged_by: "",
    shelved_until_utime: 0,
    shelved_by: "",
    ...change,
  };
}

export function listOf(alarms: Alarm[], change: Partial<AlarmList> = {}): AlarmList {
  const count = (severity: number, states: readonly number[]) =>
    alarms.filter((one) => one.severity === severity && states.includes(one.state)).length;
  return {
    type: "alarms",
    utime: 0,
    session_id: 5,
    newest_id: Math.max(0, ...alarms.map(({ id }) => id)),
    num_warnings: count(3, [0, 1]),
    num_cautions: count(2, [0, 1]),
    num_advisories: count(1, [0, 1]),
    num_unacknowledged_warnings: count(3, [0, 2]),
    num_unacknowledged_cautions: count(2, [0, 2]),
    num_unacknowledged_advisories: count(1, [0, 2]),
    num_not_listed: 0,
    alarms,
    ...change,
  };
}

/** What the list of alarms says, for people. Whether an alarm is on and who has acknowledged it only the collision-monitor says. */
import type { Alarm, AlarmBody, AlarmList } from "../link/messages";

/** alarm_t's states. */
export const kUnacknowledged = 0;
export const kAcknowledged = 1;
export const kEnded = 2;
export const kShelved = 3;
export const kOver = 4;

export const kSeverityNames = ["", "Advisory", "Caution", "Warning"] as const;

/** Somebody has to look: it flashes. */
export function wantsAcknowledgement(alarm: Alarm): boolean {
  return alarm.state === kUnacknowledged || alarm.state === kEnded;
}

export interface AlarmGroups {
  /** The most urgent first, as the monitor sorts them. */
  open: readonly Alarm[];
  shelved: readonly Alarm[];
  /** Newest first. */
  over: readonly Alarm[];
}

export function groupsOf(list: AlarmList | null): AlarmGroups {
  const alarms = list?.alarms ?? [];
  return {
    open: alarms.filter(({ state }) => state < kShelved),
    shelved: alarms.filter(({ state }) => state === kShelved),
    over: alarms.filter(({ state }) => state === kOver),
  };
}

export interface SeverityCount {
  severity: number;
  /** On, and not shelved. */
  on: number;
  unacknowledged: number;
}

/** Worst first. Counted by the monitor: its list may leave some out. */
export function countsOf(list: AlarmList | null): SeverityCount[] {
  return [
    {
      severity: 3,
      on: list?.num_warnings ?? 0,
      unacknowledged: list?.num_unacknowledged_warnings ?? 0,
    },
    {
      severity: 2,
      on: list?.num_cautions ?? 0,
      unacknowledged: list?.num_unacknowledged_cautions ?? 0,
    },
    {
      severity: 1,
      on: list?.num_advisories ?? 0,
      unacknowledged: list?.num_unacknowledged_advisories ?? 0,
    },
  ];
}

/** "2 warnings, 1 unacknowledged; no cautions" */
export function countsText(counts: readonly SeverityCount[]): string {
  return counts
    .filter(({ severity, on, unacknowledged }) => severity > 1 || on + unacknowledged > 0)
    .map(({ severity, on, unacknowledged }) => {
      const name = (kSeverityNames[severity] ?? "").toLowerCase();
      const words = `${on === 0 ? "no" : on} ${name}${on === 1 ? "" : plural(name)}`;
      return unacknowledged === 0 ? words : `${words}, ${unacknowledged} unacknowledged`;
    })
    .join("; ");
}

function plural(name: string): string {
  return name === "advisory" ? "" : "s";
}

export function acknowledge(list: AlarmList, alarm: Alarm): AlarmBody {
  return { action: "acknowledge", alarm_session_id: list.session_id, alarm_ids: [alarm.id] };
}

/** What is raised after this list came is not among them. */
export function acknowledgeAll(list: AlarmList): AlarmBody {
  return { action: "acknowledge", alarm_session_id: list.session_id, all_up_to_id: list.newest_id };
}

export function shelve(list: AlarmList, alarm: Alarm, duration_s: number): AlarmBody {
  return { action: "shelve", alarm_session_id: list.session_id, alarm_ids: [alarm.id], duration_s };
}

export function unshelve(list: AlarmList, alarm: Alarm): AlarmBody {
  return { action: "unshelve", alarm_session_id: list.session_id, alarm_ids: [alarm.id] };
}

/** "0:48", "12:05" */
export function countdown(seconds: number): string {
  const whole = Math.max(0, Math.ceil(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

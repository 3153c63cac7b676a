/** When which alarm is to be heard. Pure: the caller has the clock, and plays. */
import type { Alarm, AlarmList } from "../link/messages";
import { kUnacknowledged } from "./alarm_list";

/** A pattern is repeated after so long, for as long as something of its severity is unacknowledged; null: it is heard once. */
export const kRepeat_ms: Readonly<Record<number, number | null>> = { 3: 4000, 2: 12_000, 1: null };

/**
 * Each occurrence is heard at once when it comes, however often its message does; then the worst that is unacknowledged is
 * repeated. What has ended or is shelved is silent. An occurrence that was there before the page is heard like a new one.
 */
export class SoundSchedule {
  private session_id = 0;
  private heard_id = 0;
  private last_ms = -Infinity;

  /** The severity to be heard now; 0: none. `wanted` says which severities the person wants to hear. */
  next(list: AlarmList | null, now_ms: number, wanted: (severity: number) => boolean): number {
    if (list === null) return 0;
    if (list.session_id !== this.session_id) {
      this.session_id = list.session_id;
      this.heard_id = 0;
    }
    const sounding = list.alarms.filter((alarm) => alarm.state === kUnacknowledged && wanted(alarm.severity));
    const fresh = worstOf(sounding.filter(({ id }) => id > this.heard_id));
    this.heard_id = Math.max(this.heard_id, list.newest_id);
    const severity = fresh > 0 ? fresh : this.repeated(worstOf(sounding), now_ms);
    if (severity > 0) this.last_ms = now_ms;
    return severity;
  }

  private repeated(worst: number, now_ms: number): number {
    const period_ms = kRepeat_ms[worst] ?? null;
    return period_ms !== null && now_ms >= this.last_ms + period_ms ? worst : 0;
  }
}

function worstOf(alarms: readonly Alarm[]): number {
  return alarms.reduce((worst, { severity }) => Math.max(worst, severity), 0);
}

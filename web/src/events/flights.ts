/** Where in the list of events one flight ends and the next begins. */
import type { BusEvent } from "../link/messages";

/** Told by the simulator when a scenario is started anew, and by the controller for any fleet that starts anew. */
const kStarts: ReadonlySet<string> = new Set(["simulation_started", "fleet_restarted"]);
/** What several programs tell of one start lies no further apart [us]. */
const kOneStart_us = 10e6;

/** When flights began, newest first: as the events tell, and the present one by its roster (0: none yet). */
export function flightStarts(events: readonly BusEvent[], start_utime: number): number[] {
  const told = events.filter(({ code }) => kStarts.has(code)).map(({ utime }) => utime);
  const all = [...told, ...(start_utime > 0 ? [start_utime] : [])].sort((a, b) => a - b);
  const starts: number[] = [];
  let last = -Infinity;
  for (const utime of all) {
    if (utime - last > kOneStart_us) starts.push(utime);
    last = utime;
  }
  return starts.reverse();
}

/** The start of a flight that lies between an event and the next older one that is shown; null: both are of one flight. */
export function startBetween(starts: readonly number[], newer: BusEvent, older: BusEvent): number | null {
  return starts.find((start) => start <= newer.utime && start > older.utime) ?? null;
}

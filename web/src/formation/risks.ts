/** What speaks against Apply, and whether somebody may decide otherwise. */
import type { Conflict } from "./checks";
import type { PreviewState } from "./preview";
import { separation } from "./words";

export interface Risk {
  text: string;
  /** As the alerts: 3 is inside a cylinder, -1 that nobody knows. */
  level: 3 | -1;
}

/** Only whoever overrides all of them may apply. */
export function risksOf(
  conflicts: readonly Conflict[],
  preview: PreviewState,
  callsign: (id: number) => string,
): Risk[] {
  const risks: Risk[] = [];
  const [nearest] = conflicts;
  if (nearest !== undefined) {
    const more =
      conflicts.length > 1
        ? ` ${conflicts.length === 2 ? "So is 1 more pair" : `So are ${conflicts.length - 1} more pairs`}.`
        : "";
    risks.push({
      level: 3,
      text: `The slots of ${pair(nearest.ids, callsign)} are inside one another’s cylinder: ${separation(nearest.horizontal_m, nearest.vertical_m)}.${more}`,
    });
  }
  if (preview.kind === "failed")
    risks.push({ level: -1, text: `It could not be flown ahead: ${preview.reason}` });
  if (preview.kind !== "done") return risks;
  const { ok, reason, least } = preview.result;
  if (!ok) risks.push({ level: -1, text: `The station would refuse it: ${reason}` });
  if (ok && least?.inside_cylinder === true) {
    risks.push({
      level: 3,
      text: `${pair(least.ids, callsign)} come inside one another’s cylinder on the way: ${separation(least.horizontal_m, least.vertical_m)} after ${Math.round(least.t_s)} s.`,
    });
  }
  return risks;
}

export function pair(ids: readonly [number, number], callsign: (id: number) => string): string {
  return `${callsign(ids[0])} and ${callsign(ids[1])}`;
}

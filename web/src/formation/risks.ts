/** What speaks against Apply, and whether somebody may decide otherwise. */
import type { Conflict } from "./checks";
import type { PreviewState } from "./preview";
import { inChosenUnits } from "../units/station_text";
import { separation } from "./words";

/** The bridge flies no longer ahead than this [s]; less is for want of time to compute. */
const kLongest_s = 299;

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
    const { horizontal_m, vertical_m } = nearest;
    risks.push({
      level: 3,
      text: `The slots of ${pair(nearest.ids, callsign)} lie inside one another’s cylinder: ${separation(horizontal_m, vertical_m)}.${andMore(conflicts.length - 1)}`,
    });
  }
  if (preview.kind === "failed") {
    risks.push({ level: -1, text: `It could not be flown ahead: ${preview.reason}` });
  }
  if (preview.kind !== "done") return risks;
  const { result } = preview;
  if (!result.ok) {
    risks.push({ level: -1, text: `The station would refuse it: ${inChosenUnits(result.reason)}` });
    return risks;
  }
  if (!result.complete && result.duration_s < kLongest_s) {
    const flown_s = Math.floor(result.duration_s);
    risks.push({
      level: -1,
      text: `Only the first ${flown_s} s could be flown ahead: what comes then is not known.`,
    });
  }
  // Those whose very slots are too near are told of above.
  const known = new Set(conflicts.map(({ ids }) => ids.join()));
  const inside = result.nearest.filter(
    ({ ids, inside_cylinder }) => inside_cylinder && !known.has(ids.join()),
  );
  const [worst] = inside;
  if (worst !== undefined) {
    const { horizontal_m, vertical_m, t_s } = worst;
    risks.push({
      level: 3,
      text: `${pair(worst.ids, callsign)} come inside one another’s cylinder on the way: ${separation(horizontal_m, vertical_m)} after ${Math.round(t_s)} s.${andMore(inside.length - 1)}`,
    });
  }
  return risks;
}

function andMore(count: number): string {
  if (count <= 0) return "";
  return count === 1 ? " So does 1 more pair." : ` So do ${count} more pairs.`;
}

export function pair(ids: readonly [number, number], callsign: (id: number) => string): string {
  return `${callsign(ids[0])} and ${callsign(ids[1])}`;
}

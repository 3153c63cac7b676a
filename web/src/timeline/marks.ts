/** What stands out in a recording: to be drawn, told and jumped to. */
import type { Damage, Mark } from "../link/recording_messages";

/** Alarms and people's notes are worth a jump; of the other events there are many. */
export function isLandmark({ kind }: Mark): boolean {
  return kind !== "event";
}

/** So near it counts as where we are: what plays has gone on a little since a person pressed the key. */
const kHere_s = 0.05;
const kJustPassed_s = 1;

/** The next alarm or marker after a time, or the one before it; null: there is none. `marks` are by time. */
export function landmarkFrom(
  marks: readonly Mark[],
  t_s: number,
  direction: 1 | -1,
  playing: boolean,
): Mark | null {
  const found =
    direction === 1
      ? marks.find((mark) => isLandmark(mark) && mark.t_s > t_s + kHere_s)
      : marks.findLast((mark) => isLandmark(mark) && mark.t_s < t_s - (playing ? kJustPassed_s : kHere_s));
  return found ?? null;
}

/** How much a mark has to be seen: what lies above what. */
function weight(mark: Mark): number {
  if (mark.kind === "marker") return 10;
  return mark.severity * 2 + (mark.kind === "alarm" ? 1 : 0);
}

/** Marks that would cover one another, as one: the weightiest is drawn, and all are told. */
export interface MarkGroup {
  x_px: number;
  shown: Mark;
  marks: Mark[];
}

/** @param x_of where on the line a time is [px] @param apart_px nearer ones are one group. */
export function groupMarks(
  marks: readonly Mark[],
  x_of: (t_s: number) => number,
  apart_px: number,
): MarkGroup[] {
  const groups: MarkGroup[] = [];
  for (const mark of marks) {
    const x_px = x_of(mark.t_s);
    const last = groups.at(-1);
    if (last === undefined || x_px - last.x_px >= apart_px) {
      groups.push({ x_px, shown: mark, marks: [mark] });
      continue;
    }
    last.marks.push(mark);
    if (weight(mark) > weight(last.shown)) last.shown = mark;
  }
  return groups;
}

/** Marks that the pointer is at, the weightiest first. */
export function marksAt(
  marks: readonly Mark[],
  t_s: number,
  within_s: number,
  most: number,
): { told: Mark[]; more: number } {
  const near = marks.filter((mark) => Math.abs(mark.t_s - t_s) <= within_s);
  near.sort((a, b) => weight(b) - weight(a) || a.t_s - b.t_s);
  return { told: near.slice(0, most), more: Math.max(0, near.length - most) };
}

export const kMarkNames = {
  event: ["Event", "Advisory", "Caution", "Warning"],
  alarm: ["Alarm", "Advisory alarm", "Caution alarm", "Warning alarm"],
  marker: ["Marker", "Marker", "Marker", "Marker"],
} as const;

export function markName({ kind, severity }: Mark): string {
  return kMarkNames[kind][severity as 0 | 1 | 2 | 3] ?? "Event";
}

/** What is missing from a recording, in a sentence; "" when nothing is. */
export function damageText(damage: readonly Damage[]): string {
  const first = damage[0];
  if (first === undefined) return "";
  const places =
    damage.length === 1 ? "A part of this recording" : `${damage.length} parts of this recording`;
  return `${places} can't be read: everything else is played.`;
}

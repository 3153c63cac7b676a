/** What the list says of a recording. */
import type { ListedRecording } from "../link/recording_messages";
import { utcDay } from "../timeline/time_text";
import { duration, utc } from "../units/format";
import { size } from "../units/size";

const count = (n: number, one: string, many: string) => `${n} ${n === 1 ? one : many}`;

/** When and for how long: "2026-11-25 14:30:00 UTC, 12 min 5 s". */
export function whenText({ start_utime, duration_s }: ListedRecording): string {
  if (start_utime === null) return "";
  const length = duration_s === null ? "" : `, ${duration(duration_s)}`;
  return `${utcDay(start_utime)} ${utc(start_utime)} UTC${length}`;
}

/** Who and how much: "3 UAVs, 1.4 MB in 2 parts, 1 marker". */
export function whatText({ vehicles, bytes, parts, markers }: ListedRecording): string {
  return [
    vehicles === null ? "" : count(vehicles, "UAV", "UAVs"),
    parts > 1 ? `${size(bytes)} in ${parts} parts` : size(bytes),
    markers === null || markers === 0 ? "" : count(markers, "marker", "markers"),
  ]
    .filter(Boolean)
    .join(", ");
}

/** "" until it is known. */
export function alarmsText({ alarms, warnings }: ListedRecording): string {
  if (alarms === null) return "";
  if (alarms === 0) return "No alarm";
  const of_them = warnings === null || warnings === 0 ? "" : `, ${count(warnings, "warning", "warnings")}`;
  return `${count(alarms, "alarm", "alarms")}${of_them}`;
}

/** Those that a person looks for: every word in the scenario, the name or the day. */
export function found(recordings: readonly ListedRecording[], text: string): ListedRecording[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return recordings.filter((recording) => {
    const told = `${recording.scenario ?? ""} ${recording.name} ${whenText(recording)}`.toLowerCase();
    return words.every((word) => told.includes(word));
  });
}

/** The page that shows it. */
export function pageOf(name: string): string {
  return `?recording=${encodeURIComponent(name)}`;
}

/** Where its file is, or one of its parts (0, 1, ...). */
export function fileOf(name: string, part: number): string {
  return `api/recordings/${encodeURIComponent(name)}/file${part > 0 ? `?part=${part}` : ""}`;
}

/** What the charts of one panel share. */
import { signal } from "@preact/signals";
import { remembered } from "../state/remembered";
import type { ColumnName } from "./flight_series";
import { kAll, type TimeWindow } from "./time_window";

export const time_window = signal<TimeWindow>(kAll);
/** The flight that `time_window` is of, by its start. */
let window_start_utime = 0;

/** A part of another flight says nothing about this one: then all of it is shown. */
export function showFlight(start_utime: number): void {
  if (start_utime === window_start_utime) return;
  window_start_utime = start_utime;
  time_window.value = kAll;
}

/** Where the cursor is, in step on all charts; null: nowhere. */
export const cursor_s = signal<number | null>(null);

/** Charts that this browser's person doesn't want to see. */
export const hidden_charts = remembered<readonly ColumnName[]>("charts.hidden", [], (stored) =>
  Array.isArray(stored) ? (stored as ColumnName[]) : null,
);

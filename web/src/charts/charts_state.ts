/** What the charts of one panel share. */
import { signal } from "@preact/signals";
import { remembered } from "../state/remembered";
import type { ColumnName } from "./flight_series";
import { kAll, type TimeWindow } from "./time_window";

export const time_window = signal<TimeWindow>(kAll);
/** Where the cursor is, in step on all charts; null: nowhere. */
export const cursor_s = signal<number | null>(null);

/** Charts that this browser's person doesn't want to see. */
export const hidden_charts = remembered<readonly ColumnName[]>("charts.hidden", [], (stored) =>
  Array.isArray(stored) ? (stored as ColumnName[]) : null,
);

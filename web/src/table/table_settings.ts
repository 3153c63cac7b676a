/** How this browser's person likes the table. */
import { signal } from "@preact/signals";
import { remembered } from "../state/remembered";
import { kSortKeys, kWorstFirst, type Order, type Show } from "./row_order";

export const order = remembered<Order>("table.order", kWorstFirst, (stored) => {
  const { key, reversed } = (stored ?? {}) as Partial<Order>;
  return key !== undefined && kSortKeys.includes(key) && typeof reversed === "boolean"
    ? { key, reversed }
    : null;
});

/** Ids of columns. */
export const hidden_columns = remembered<readonly string[]>("table.hidden", [], (stored) =>
  Array.isArray(stored) ? stored.filter((id) => typeof id === "string") : null,
);

// A filter hides UAVs: it doesn't outlive the page.
export const show = signal<Show>("all");
export const filter_text = signal("");

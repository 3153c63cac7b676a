/** How this browser's person likes the table. */
import { signal } from "@preact/signals";
import { remembered } from "../state/remembered";
import { kWorstFirst, type Order, type Show, type SortKey } from "./row_order";

export const order = remembered<Order>("table.order", kWorstFirst, (stored) => {
  const { key, reversed } = (stored ?? {}) as Partial<Order>;
  return typeof key === "string" && typeof reversed === "boolean" ? { key: key as SortKey, reversed } : null;
});

/** Ids of columns. */
export const hidden_columns = remembered<readonly string[]>("table.hidden", [], (stored) =>
  Array.isArray(stored) ? stored.filter((id) => typeof id === "string") : null,
);

// A filter hides UAVs: it doesn't outlive the page.
export const show = signal<Show>("all");
export const filter_text = signal("");

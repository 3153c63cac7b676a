/** Who is drawn, and how the curves are told apart. */
import type { Vehicle } from "../link/messages";
import type { Fleet } from "../state/fleet";
import { kWorstFirst, orderIds } from "../table/row_order";

/** More curves than these can't be told apart. */
export const kMostCurves = 8;

/** By id, so that a UAV always looks the same; with the six identity colours, 24 ids in a row all differ. */
const kDashes: readonly (readonly number[])[] = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

export function dashOf(id: number): number[] {
  const dash = (id - 1 + Math.floor((id - 1) / 12)) % kDashes.length;
  return [...(kDashes[dash] ?? [])];
}

/** The selected ones; without any, the worst. In order of id, at most as many as can be told apart. */
export function drawnIds(
  fleet: Fleet,
  vehicles: readonly Vehicle[],
  selection: ReadonlySet<number>,
): number[] {
  const asked = selection.size === 0 ? vehicles : vehicles.filter(({ id }) => selection.has(id));
  const worst = orderIds(fleet, asked, kWorstFirst, new Map());
  return worst.slice(0, kMostCurves).sort((a, b) => a - b);
}

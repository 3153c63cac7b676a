/** The table's rows from beat to beat: the order is made anew every two seconds at most, and stands still while somebody is at it. */
import type { Formation, FormationStatus, Roster } from "../link/messages";
import type { Fleet } from "../state/fleet";
import { filterVehicles, orderIds, type Order, type Show } from "./row_order";

const kOrderFor_ms = 2000;

/** What a person or the bus has changed: then the list is made anew at once. */
export interface ListWish {
  roster: Roster | null;
  order: Order;
  show: Show;
  text: string;
}

export class RowList {
  ids: readonly number[] = [];
  /** The order is no longer what it would be. */
  outdated = false;
  private wish: ListWish | null = null;
  private made_ms = 0;

  /** `held`: the pointer or the focus is in the table. */
  update(
    fleet: Fleet,
    wish: ListWish,
    formations: ReadonlyMap<number, Formation>,
    statuses: ReadonlyMap<number, FormationStatus>,
    now_ms: number,
    held: boolean,
  ): void {
    const changed =
      this.wish === null ||
      this.wish.roster !== wish.roster ||
      this.wish.order !== wish.order ||
      this.wish.show !== wish.show ||
      this.wish.text !== wish.text;
    if (!changed && now_ms - this.made_ms < kOrderFor_ms) return;
    const vehicles = filterVehicles(fleet, wish.roster?.vehicles ?? [], wish.show, wish.text, formations);
    const ids = orderIds(fleet, vehicles, wish.order, statuses);
    this.made_ms = now_ms;
    this.outdated = !changed && held && !same(ids, this.ids);
    if (changed || !held) this.ids = ids;
    this.wish = wish;
  }
}

function same(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((id, i) => id === b[i]);
}

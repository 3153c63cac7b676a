import { useSignal } from "@preact/signals";
import type { RefObject } from "preact";
import { useCallback, useRef } from "preact/hooks";
import type { Vehicle } from "../link/messages";
import type { Station } from "../shell/station";
import type { Column } from "./columns";
import type { Order } from "./row_order";
import { clickRow } from "./select_rows";
import { TableHead } from "./table_head";
import { rowElementId, UavRowView } from "./uav_row";
import { useVirtualRows } from "./virtual_rows";

interface UavGridProps {
  station: Station;
  scroller: RefObject<HTMLDivElement | null>;
  columns: readonly Column[];
  ids: readonly number[];
  vehicles: ReadonlyMap<number, Vehicle>;
  order: Order;
  setOrder: (order: Order) => void;
}

/** Rows that a page key moves by. */
const kPage = 10;

/** The table itself: one stop of the Tab key, the arrows move in it, and only the rows in view exist. */
export function UavGrid({ station, scroller, columns, ids, vehicles, order, setOrder }: UavGridProps) {
  const { store } = station;
  const rows = useVirtualRows(scroller, ids.length);
  /** Where the keyboard is, and where a range begins that Shift selects. */
  const active_id = useSignal<number | null>(null);
  const anchor = useRef<number | null>(null);
  const active =
    active_id.value !== null && vehicles.has(active_id.value) ? active_id.value : (ids[0] ?? null);

  const moveTo = (index: number, extend: boolean) => {
    const to = Math.min(Math.max(index, 0), ids.length - 1);
    const id = ids[to];
    if (id === undefined) return;
    if (extend) clickRow(store, ids, id, anchor.current ?? active, { shift: true, ctrl: false });
    else anchor.current = id;
    active_id.value = id;
    rows.reveal(to);
  };
  const pressed = (event: MouseEvent, id: number) => {
    if (event.target instanceof Element && event.target.closest("button") !== null) return;
    const keys = { shift: event.shiftKey, ctrl: event.ctrlKey || event.metaKey };
    clickRow(store, ids, id, anchor.current, keys);
    if (!keys.shift) anchor.current = id;
    active_id.value = id;
  };
  // Always the same function: a row that stays in view while the table is scrolled isn't drawn again.
  const newest_pressed = useRef(pressed);
  newest_pressed.current = pressed;
  const press = useCallback((event: MouseEvent, id: number) => {
    newest_pressed.current(event, id);
  }, []);
  const onKey = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget) return;
    const at = active === null ? -1 : ids.indexOf(active);
    const extend = event.shiftKey;
    const actions: Record<string, () => void> = {
      ArrowDown: () => {
        // The first press goes to the first row, which the focus is shown at already.
        moveTo(active_id.value === null ? 0 : at + 1, extend);
      },
      ArrowUp: () => {
        moveTo(at - 1, extend);
      },
      PageDown: () => {
        moveTo(at + kPage, extend);
      },
      PageUp: () => {
        moveTo(at - kPage, extend);
      },
      Home: () => {
        moveTo(0, extend);
      },
      End: () => {
        moveTo(ids.length - 1, extend);
      },
      " ": () => {
        if (active !== null) store.toggleSelected(active);
      },
      Enter: () => {
        if (active !== null) centreMap(station, active);
      },
      Escape: () => {
        store.select([]);
      },
    };
    const action =
      (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "a"
        ? () => {
            store.select(ids);
          }
        : event.ctrlKey || event.metaKey || event.altKey
          ? undefined
          : actions[event.key];
    if (action === undefined) return;
    event.preventDefault();
    action();
  };

  const drawn = rows.rows.filter(({ index }) => index < ids.length);
  const active_drawn = drawn.some(({ index }) => ids[index] === active);
  const template = columns.map(({ width_px }) => `minmax(${width_px}px, ${width_px}fr)`).join(" ");
  return (
    <table
      class="uav-table"
      role="grid"
      aria-label="Formation information"
      aria-rowcount={ids.length + 1}
      aria-colcount={columns.length}
      aria-multiselectable="true"
      aria-activedescendant={active_drawn && active !== null ? rowElementId(active) : undefined}
      data-keys
      tabIndex={0}
      style={{ "--columns": template }}
      onKeyDown={onKey}
    >
      <TableHead columns={columns} order={order} setOrder={setOrder} />
      <tbody role="rowgroup" style={{ height: `${rows.total_px}px` }}>
        {drawn.map(({ index, top_px, element }) => {
          const id = ids[index] ?? 0;
          const vehicle = vehicles.get(id);
          return (
            vehicle !== undefined && (
              <UavRowView
                key={element}
                vehicle={vehicle}
                station={station}
                columns={columns}
                index={index}
                top_px={top_px}
                active={id === active}
                press={press}
              />
            )
          );
        })}
      </tbody>
    </table>
  );
}

function centreMap(station: Station, id: number): void {
  const { store } = station;
  const row = store.fleet.motionRow(id);
  const map = station.map.value;
  if (row < 0 || map === null) return;
  const { east_m, north_m, up_m } = store.fleet.placeAt(row, performance.now());
  const place = map.place(east_m, north_m, up_m);
  if (place !== null) map.centre(place);
}

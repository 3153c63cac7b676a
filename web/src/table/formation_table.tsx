import { useSignal } from "@preact/signals";
import { useMemo, useRef } from "preact/hooks";
import "./table.css";
import { lateSentence } from "../payload/late_sentence";
import type { PanelProps } from "../shell/panel_props";
import { kColumns, kLinkColumn } from "./columns";
import { RowList } from "./row_list";
import { inForce } from "./row_order";
import { filter_text, hidden_columns, order, show } from "./table_settings";
import { TableToolbar } from "./table_toolbar";
import { UavGrid } from "./uav_grid";
import { useWidth } from "./use_width";

const kSimulator = "fleet-simulator";
/** A pointer or a focus that rests in the table for so long isn't somebody at work: the worst must come first again. */
const kHeldFor_ms = 15_000;

/** The paper's Formation Information: a row a UAV, worst first. */
export function FormationTable({ station }: PanelProps) {
  const { store } = station;
  const now_ms = store.now_ms.value;
  const roster = store.roster.value;
  const scroller = useRef<HTMLDivElement>(null);
  const width_px = useWidth(scroller);
  const list = useRef(new RowList()).current;
  const pointer_in = useSignal(false);
  const focus_in = useSignal(false);
  const vehicles = useMemo(() => new Map(roster?.vehicles.map((vehicle) => [vehicle.id, vehicle])), [roster]);

  const shown = inForce(show.value, store.formations.value);
  const wish = { roster, order: order.value, show: shown, text: filter_text.value };
  const touched_ms = useRef(-Infinity);
  const touch = () => {
    touched_ms.current = performance.now();
  };
  const held = (pointer_in.value || focus_in.value) && now_ms - touched_ms.current < kHeldFor_ms;
  list.update(store.fleet, wish, store.formations.value, store.statuses.value, now_ms, held);

  const hidden = hidden_columns.value;
  // One that has fallen silent is missed, not gone: what it was asked last and how that ended stays to be seen.
  const simulated = store.heartbeats.value.has(kSimulator);
  const wanted = kColumns.filter(({ id }) => !hidden.includes(id));
  const needed_px = [...wanted, kLinkColumn].reduce((sum, column) => sum + column.width_px, 0);
  const columns = simulated && needed_px <= width_px ? [...wanted, kLinkColumn] : wanted;

  return (
    <section class="table-panel" aria-label="Formation information">
      <TableToolbar station={station} shown={list.ids} held={list.outdated} />
      <p class="payload-message" role="status">
        {lateSentence(store, station.payloads, now_ms)}
      </p>
      <div
        class="table-scroll"
        ref={scroller}
        onPointerEnter={() => (pointer_in.value = true)}
        onPointerLeave={() => (pointer_in.value = false)}
        onFocusIn={() => {
          focus_in.value = true;
          touch();
        }}
        onFocusOut={() => (focus_in.value = false)}
        onPointerMove={touch}
        onKeyDown={touch}
        onScroll={touch}
      >
        <UavGrid
          station={station}
          scroller={scroller}
          columns={columns}
          ids={list.ids}
          vehicles={vehicles}
          order={order.value}
          setOrder={(wanted_order) => (order.value = wanted_order)}
        />
        {list.ids.length === 0 && (
          <p class="empty">
            {vehicles.size === 0
              ? "No UAV is known yet: rows come with the roster of a flight."
              : "No UAV is like that. Change the filter, or clear it."}
          </p>
        )}
      </div>
    </section>
  );
}

import type { Station } from "../shell/station";
import { uavRow } from "../state/rows";
import type { Column } from "./columns";
import type { Vehicle } from "../link/messages";

export const rowElementId = (id: number) => `uav-row-${id}`;

interface UavRowProps {
  vehicle: Vehicle;
  station: Station;
  columns: readonly Column[];
  /** From 0, in the whole table. */
  index: number;
  top_px: number;
  /** The keyboard is at it. */
  active: boolean;
  press: (event: MouseEvent, id: number) => void;
}

/** A row of what is on the screen now; its element will show another UAV when the table is scrolled. */
export function UavRowView({ vehicle, station, columns, index, top_px, active, press }: UavRowProps) {
  const { store } = station;
  const row = uavRow(store.fleet, vehicle, store.now_ms.value);
  const selected = store.selection.value.has(row.id);
  const classes = [
    "uav-row",
    row.stale ? "stale-row" : "",
    selected ? "selected" : "",
    active ? "active" : "",
  ];
  return (
    <tr
      role="row"
      id={rowElementId(row.id)}
      data-id={row.id}
      data-level={row.level}
      class={classes.filter(Boolean).join(" ")}
      aria-rowindex={index + 2}
      aria-selected={selected}
      style={{ transform: `translateY(${top_px}px)` }}
      onClick={(event) => {
        press(event, row.id);
      }}
    >
      {columns.map((column) => (
        <td
          key={column.id}
          role={column.id === "uav" ? "rowheader" : "gridcell"}
          class={column.class === undefined ? column.align : `${column.align} ${column.class}`}
        >
          {column.cell(row, { station, tab_index: active ? 0 : -1 })}
        </td>
      ))}
    </tr>
  );
}

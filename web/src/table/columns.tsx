/** The table's columns: what stands in their heads and cells, how wide they are and how they sort. */
import type { VNode } from "preact";
import { Chain, kLinkNames, Lamp } from "../panels/icons";
import type { UavRow } from "../state/rows";
import { compass, fixed, kNone } from "../units/format";
import { altitude, distance, errorText, kAltitudeReference, speed } from "../units/quantities";
import type { CellContext } from "./cell_context";
import { Chip } from "./chip";
import { LinkButtons } from "./link_buttons";
import { modeOf } from "./mode";
import { PayloadCell } from "./payload_cell";
import type { SortKey } from "./row_order";

export interface Column {
  id: string;
  name: string;
  /** Two lines: what it is, and its unit or what it is counted from. */
  head: string;
  detail: () => string;
  /** For the head's hint. */
  meaning: string;
  /** Least width; what is left over is shared. */
  width_px: number;
  align: "left" | "centre" | "right";
  /** Null: it can't be sorted by. */
  sort: SortKey | null;
  /** Sorted up at first: the smallest is on top. */
  rising: boolean;
  class?: string;
  cell: (row: UavRow, context: CellContext) => VNode | string;
}

/** Below this the link is as good as it can be, and its age is no news [s]. */
const kShownAge_s = 1;

/** What takes longer is far from a threat, and would not fit [s]. */
const kLongTau_s = 999;

function link(direction: string, state: number, age_s: number): VNode {
  const age = age_s >= kShownAge_s ? `${fixed(Math.min(age_s, 9999))} s` : "";
  return (
    <>
      <Chain state={state} label={`${direction} ${kLinkNames[state] ?? "unknown"}`} />
      <span class="link-age">{age}</span>
    </>
  );
}

const number = (value: number | undefined, text: (value: number) => string) =>
  value === undefined ? kNone : text(value);

const other = (id: number | undefined, { station }: CellContext) =>
  id === undefined ? kNone : <Chip id={id} title={station.store.callsign(id)} />;

const right = { align: "right", rising: false, detail: () => "" } as const;

export const kColumns: readonly Column[] = [
  {
    ...right,
    id: "level",
    name: "Warning level",
    head: "",
    meaning: "Warning level",
    width_px: 30,
    align: "centre",
    sort: "level",
    class: "pinned pinned-level",
    cell: (row) => <Lamp level={row.level} />,
  },
  {
    ...right,
    id: "uav",
    name: "UAV",
    head: "UAV",
    meaning: "Id and callsign",
    width_px: 104,
    align: "left",
    sort: "id",
    rising: true,
    class: "pinned pinned-uav uav-name",
    cell: (row) => (
      <>
        <Chip id={row.id} />
        <span>{row.callsign}</span>
      </>
    ),
  },
  {
    ...right,
    id: "downlink",
    name: "Downlink",
    head: "Downlink",
    detail: () => "heard",
    meaning: "UAV to station, and how long since it was heard",
    width_px: 78,
    align: "left",
    sort: "downlink",
    cell: (row) => link("Downlink", row.downlink, row.downlink_age_s),
  },
  {
    ...right,
    id: "uplink",
    name: "Uplink",
    head: "Uplink",
    detail: () => "obeyed",
    meaning: "Station to UAV, and how long since it obeyed",
    width_px: 78,
    align: "left",
    sort: "uplink",
    cell: (row) => link("Uplink", row.uplink, row.uplink_age_s),
  },
  {
    ...right,
    id: "forward",
    name: "Error forward",
    head: "Forward",
    detail: () => `error, ${distance.unit()}`,
    meaning: "Error from its slot, forward: the slot is so far ahead",
    width_px: 64,
    sort: "forward",
    class: "value error",
    cell: (row) => number(row.error?.forward_m, (m) => errorText(distance, m)),
  },
  {
    ...right,
    id: "left",
    name: "Error left",
    head: "Left",
    detail: () => `error, ${distance.unit()}`,
    meaning: "Error from its slot, left: the slot is so far to the left",
    width_px: 64,
    sort: "left",
    class: "value error",
    cell: (row) => number(row.error?.left_m, (m) => errorText(distance, m)),
  },
  {
    ...right,
    id: "up",
    name: "Error up",
    head: "Up",
    detail: () => `error, ${altitude.unit()}`,
    meaning: "Error from its slot, up: the slot is so far above",
    width_px: 64,
    sort: "up",
    class: "value error",
    cell: (row) => number(row.error?.up_m, (m) => errorText(altitude, m)),
  },
  {
    ...right,
    id: "nearest",
    name: "Nearest UAV",
    head: "Nearest",
    detail: () => "UAV",
    meaning: "The nearest other UAV",
    width_px: 56,
    align: "centre",
    sort: "nearest",
    rising: true,
    cell: (row, context) => other(row.nearest?.id, context),
  },
  {
    ...right,
    id: "horizontal",
    name: "Horizontal distance R",
    head: "R",
    detail: () => distance.unit(),
    meaning: "Horizontal distance to the nearest",
    width_px: 54,
    sort: "horizontal",
    rising: true,
    class: "value",
    cell: (row) => number(row.nearest?.horizontal_m, distance.text),
  },
  {
    ...right,
    id: "vertical",
    name: "Vertical distance H",
    head: "H",
    detail: () => altitude.unit(),
    meaning: "Vertical distance to the nearest",
    width_px: 50,
    sort: "vertical",
    rising: true,
    class: "value",
    cell: (row) => number(row.nearest?.vertical_m, altitude.text),
  },
  {
    ...right,
    id: "tau_id",
    name: "Tau: UAV",
    head: "Tau",
    detail: () => "UAV",
    meaning: "The UAV that will be met first",
    width_px: 46,
    align: "centre",
    sort: "tau",
    rising: true,
    cell: (row, context) => other(row.tau?.id, context),
  },
  {
    ...right,
    id: "tau",
    name: "Tau: seconds",
    head: "Tau",
    detail: () => "s",
    meaning: "Time until the closest approach to it; a dash: nobody closes",
    width_px: 52,
    sort: "tau",
    rising: true,
    class: "value tau",
    cell: (row) => number(row.tau?.seconds, (s) => (s < kLongTau_s ? fixed(s) : `>${kLongTau_s}`)),
  },
  {
    ...right,
    id: "altitude",
    name: "Altitude",
    head: "Altitude",
    detail: () => `${altitude.unit()} ${kAltitudeReference}`,
    meaning: "Above the origin of the local ENU frame",
    width_px: 64,
    sort: "altitude",
    class: "value altitude",
    cell: (row) => number(row.motion?.up_m, altitude.text),
  },
  {
    ...right,
    id: "speed",
    name: "Speed",
    head: "Speed",
    detail: () => speed.unit(),
    meaning: "Along its way",
    width_px: 54,
    sort: "speed",
    class: "value speed",
    cell: (row) => number(row.motion?.speed_m_s, (m_s) => speed.text(m_s, 1)),
  },
  {
    ...right,
    id: "course",
    name: "Course",
    head: "Course",
    detail: () => "°",
    meaning: "Compass degrees",
    width_px: 54,
    sort: "course",
    rising: true,
    class: "value course",
    cell: (row) => number(row.motion?.course_rad, compass),
  },
  {
    ...right,
    id: "payload",
    name: "Payload",
    head: "Payload",
    meaning: "On or off, as telemetry says",
    width_px: 60,
    align: "centre",
    sort: "payload",
    // Key by id: what was pressed belongs to a UAV, not to a place in the table.
    cell: (row, context) => <PayloadCell key={row.id} row={row} {...context} />,
  },
  {
    ...right,
    id: "mode",
    name: "Mode",
    head: "Mode",
    meaning: "What its formation is doing; lost, or free of any formation",
    width_px: 92,
    align: "left",
    sort: "mode",
    rising: true,
    class: "mode",
    cell: (row, { station }) => {
      const { text, why } = modeOf(row, station.store);
      return <span title={why}>{text}</span>;
    },
  },
];

/** The last column, where a simulator is on the bus and there is room. */
export const kLinkColumn: Column = {
  ...right,
  id: "link",
  name: "Link control",
  head: "Link",
  detail: () => "simulated",
  meaning: "Cuts and restores the simulated data link",
  width_px: 130,
  align: "centre",
  sort: null,
  cell: (row, context) => <LinkButtons key={row.id} row={row} {...context} />,
};

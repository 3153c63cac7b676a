/** Which UAVs the table shows, and in which order. Works on the fleet's columns: no record is made for rows that nobody sees. */
import { kHasSlot } from "../link/frames";
import type { Formation, Vehicle } from "../link/messages";
import { kLinkLate, kLinkLost, type Fleet } from "../state/fleet";

export const kSortKeys = [
  "worst",
  "id",
  "level",
  "downlink",
  "uplink",
  "forward",
  "left",
  "up",
  "nearest",
  "horizontal",
  "vertical",
  "tau",
  "altitude",
  "speed",
  "course",
  "payload",
  "mode",
] as const;
export type SortKey = (typeof kSortKeys)[number];

export interface Order {
  key: SortKey;
  /** The other way round than the column's own first order. */
  reversed: boolean;
}

export const kWorstFirst: Order = { key: "worst", reversed: false };

/** Slot errors of less than this are all the same to "worst first"; beyond, each doubling is worse. Else rows would dance. */
const kSmallError_m = 20;

/** What a UAV without this value counts as: it comes last, whichever way round. */
const kNothing = Number.NaN;

/** What a row is sorted by: smaller comes first. */
function keyOf(fleet: Fleet, vehicle: Vehicle, key: SortKey, formations: Formations): number {
  const m = fleet.motionRow(vehicle.id);
  const s = fleet.statusRow(vehicle.id);
  const motion = m < 0 ? null : fleet.motion;
  const status = s < 0 ? null : fleet.status;
  const positive = (value: number | undefined) => (value === undefined || value < 0 ? kNothing : value);
  const error = (column: Float32Array | undefined) =>
    status === null || column === undefined || (status.flags[s] & kHasSlot) === 0
      ? kNothing
      : -Math.abs(column[s]);
  switch (key) {
    case "worst":
      return -worst(fleet, s);
    case "id":
      return vehicle.id;
    case "level":
      return status === null ? kNothing : -status.level[s];
    case "downlink":
      return -positive(status?.downlink_age_s[s]);
    case "uplink":
      return -positive(status?.uplink_age_s[s]);
    case "forward":
      return error(status?.forward_error_m);
    case "left":
      return error(status?.left_error_m);
    case "up":
      return error(status?.up_error_m);
    case "nearest":
      return status === null || status.nearest_id[s] === 0 ? kNothing : status.nearest_id[s];
    case "horizontal":
      return positive(status?.nearest_horizontal_m[s]);
    case "vertical":
      return positive(status?.nearest_vertical_m[s]);
    case "tau":
      return positive(status?.tau_s[s]);
    case "altitude":
      return motion === null ? kNothing : -motion.up_m[m];
    case "speed":
      return motion === null ? kNothing : -motion.speed_m_s[m];
    case "course": {
      if (motion === null) return kNothing;
      const compass_rad = (Math.PI / 2 - motion.course_rad[m]) % (2 * Math.PI);
      return compass_rad < 0 ? compass_rad + 2 * Math.PI : compass_rad;
    }
    case "payload":
      return !vehicle.has_payload || motion === null ? kNothing : -motion.flags[m];
    case "mode":
      if (status === null || status.formation_id[s] === 0) return kNothing;
      return fleet.isLost(vehicle.id) ? -1 : (formations.get(status.formation_id[s])?.mode ?? kNothing);
  }
}

type Formations = ReadonlyMap<number, { mode: number }>;

/** One number for how bad it is: the level above all, then the link, then the error from the slot. */
function worst(fleet: Fleet, s: number): number {
  const status = fleet.status;
  if (s < 0 || status === null) return 0;
  const link = Math.max(badness(status.downlink[s]), badness(status.uplink[s]));
  const error_m =
    (status.flags[s] & kHasSlot) === 0
      ? 0
      : Math.hypot(status.forward_error_m[s], status.left_error_m[s], status.up_error_m[s]);
  const doublings = error_m <= kSmallError_m ? 0 : Math.ceil(Math.log2(error_m / kSmallError_m));
  return status.level[s] * 10_000 + link * 1000 + doublings;
}

/** Not judged (3) is no worse than up: it says nothing. */
function badness(link: number): number {
  return link === kLinkLost ? 2 : link === kLinkLate ? 1 : 0;
}

/** Ids of `vehicles` in order; those that are equal by id, so that the order is always the same. */
export function orderIds(
  fleet: Fleet,
  vehicles: readonly Vehicle[],
  order: Order,
  formations: Formations,
): number[] {
  const sign = order.reversed ? -1 : 1;
  return vehicles
    .map((vehicle) => ({ id: vehicle.id, key: keyOf(fleet, vehicle, order.key, formations) * sign }))
    .sort((a, b) => {
      const without = Number(Number.isNaN(a.key)) - Number(Number.isNaN(b.key));
      if (without !== 0) return without;
      return (Number.isNaN(a.key) ? 0 : a.key - b.key) || a.id - b.id;
    })
    .map(({ id }) => id);
}

/** "all", "alerting", "lost", or the id of a formation. */
export type Show = "all" | "alerting" | "lost" | number;

/** A formation that is flown no more filters nothing; when it comes back it does again. */
export function inForce(show: Show, formations: ReadonlyMap<number, unknown>): Show {
  return typeof show === "number" && !formations.has(show) ? "all" : show;
}

/** Those that are to be shown: `text` is looked for in callsign, id, model and name of the formation. */
export function filterVehicles(
  fleet: Fleet,
  vehicles: readonly Vehicle[],
  show: Show,
  text: string,
  formations: ReadonlyMap<number, Formation>,
): Vehicle[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return vehicles.filter((vehicle) => {
    const s = fleet.statusRow(vehicle.id);
    const status = s < 0 ? null : fleet.status;
    if (show === "alerting" && (status === null || status.level[s] === 0)) return false;
    if (show === "lost" && !(status?.downlink[s] === kLinkLost || status?.uplink[s] === kLinkLost))
      return false;
    if (typeof show === "number" && status?.formation_id[s] !== show) return false;
    if (words.length === 0) return true;
    const formation = formations.get(status?.formation_id[s] ?? 0)?.name ?? "";
    const told = `${vehicle.callsign} ${vehicle.id} ${vehicle.model} ${formation}`.toLowerCase();
    return words.every((word) => told.includes(word));
  });
}

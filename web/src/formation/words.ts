/** Places in a formation, conflicts and formations as people read them. */
import type { Formation } from "../link/messages";
import { altitude, distance } from "../units/quantities";
import { isShape, kShapeNames, type Offset } from "./shapes";

/** "433 m behind, 250 m left": seen from the leader. */
export function inWords({ forward_m, left_m, up_m }: Offset): string {
  const part = (metres: number, positive: string, negative: string, quantity = distance) =>
    Math.abs(metres) < 0.5 ? [] : [`${quantity.full(Math.abs(metres))} ${metres > 0 ? positive : negative}`];
  const parts = [
    ...part(forward_m, "ahead", "behind"),
    ...part(left_m, "left", "right"),
    ...part(up_m, "higher", "lower", altitude),
  ];
  return parts.length === 0 ? "at the leader" : parts.join(", ");
}

/** "R 120 m, H 0 m". */
export function separation(horizontal_m: number, vertical_m: number): string {
  return `R ${distance.full(horizontal_m)}, H ${altitude.full(vertical_m)}`;
}

export function shapeName(shape: string): string {
  return isShape(shape) ? kShapeNames[shape] : kShapeNames.custom;
}

/** "Column of 3, 400 m apart, control skein": as read back from the bus. */
export function flownInWords(formation: Formation): string {
  const spacing = formation.spacing_m > 0 ? `, ${distance.full(formation.spacing_m)} apart` : "";
  const hold = formation.hold ? ", holding" : "";
  return `${shapeName(formation.shape)} of ${formation.slots.length}${spacing}, control ${formation.control}${hold}`;
}

/** What is wrong with a draft, before anybody flies it. */
import type { Formation } from "../link/messages";
import type { Draft, Limits } from "./draft";
import type { Offset } from "./shapes";

/** Two slots inside one another's cylinder: |dz| < H and horizontal distance < R, as cpp/core/proximity.h says. */
export interface Conflict {
  ids: readonly [number, number];
  horizontal_m: number;
  vertical_m: number;
}

export function conflictsOf(
  slots: readonly (Offset & { vehicle_id: number })[],
  { radius_m, height_m }: Pick<Limits, "radius_m" | "height_m">,
): Conflict[] {
  const conflicts: Conflict[] = [];
  // From the foremost on, only those less than R behind can be near.
  const order = [...slots].sort((a, b) => b.forward_m - a.forward_m);
  order.forEach((one, i) => {
    for (let j = i + 1; j < order.length; j += 1) {
      const other = order[j];
      if (other === undefined || one.forward_m - other.forward_m >= radius_m) break;
      const vertical_m = Math.abs(one.up_m - other.up_m);
      const horizontal_m = Math.hypot(one.forward_m - other.forward_m, one.left_m - other.left_m);
      if (vertical_m >= height_m || horizontal_m >= radius_m) continue;
      const ids = [one.vehicle_id, other.vehicle_id].sort((a, b) => a - b) as [number, number];
      conflicts.push({ ids, horizontal_m, vertical_m });
    }
  });
  return conflicts.sort(
    (a, b) => a.horizontal_m - b.horizontal_m || a.ids[0] - b.ids[0] || a.ids[1] - b.ids[1],
  );
}

/** Why a draft can't be applied at all, a sentence each. */
export function problemsOf(
  draft: Draft,
  formations: ReadonlyMap<number, Formation>,
  callsign: (id: number) => string,
  in_fleet: (id: number) => boolean,
): string[] {
  const problems: string[] = [];
  const { limits, slots } = draft;
  if (slots.length === 0)
    problems.push("It has no UAV yet: select some on the map or in the table and add them.");
  if (limits.d_mod_m < limits.radius_m)
    problems.push("D_mod must be at least R, or the alert levels come in the wrong order.");
  if (limits.caution_tau_s >= limits.advisory_tau_s)
    problems.push("Tau of a caution must be less than that of an advisory.");
  const elsewhere = new Map<number, Formation>();
  for (const formation of formations.values()) {
    if (formation.formation_id === draft.formation_id) continue;
    for (const slot of formation.slots) elsewhere.set(slot.vehicle_id, formation);
  }
  for (const { vehicle_id } of slots) {
    const other = elsewhere.get(vehicle_id);
    if (other !== undefined) {
      const name = other.name === "" ? `formation ${other.formation_id}` : other.name;
      problems.push(`${callsign(vehicle_id)} flies in ${name} already: take it out there first.`);
    }
    if (!in_fleet(vehicle_id)) problems.push(`${callsign(vehicle_id)} is not in the fleet.`);
  }
  return problems;
}

/** A formation as it is being edited: plain values, changed by making new ones. */
import type { Formation, FormationBody, Slot } from "../link/messages";
import { isControl, kGains, type Control } from "./gains";
import { isShape, shapeSlots, type Offset, type Shape } from "./shapes";

/** Thresholds between members. */
export interface Limits {
  radius_m: number;
  height_m: number;
  d_mod_m: number;
  advisory_tau_s: number;
  caution_tau_s: number;
}

/** Gains that differ from the preset, by name. */
export type Overrides = Readonly<Record<string, number>>;

export interface Draft {
  readonly formation_id: number;
  readonly name: string;
  readonly control: Control;
  /** Of each law, so that looking at the other one loses nothing. */
  readonly gains: Readonly<Record<Control, Overrides>>;
  readonly shape: Shape | "custom";
  /** Kept while the shape is custom, for when it has a shape again. */
  readonly spacing_m: number;
  readonly lead_m: number;
  readonly limits: Limits;
  /** Foremost first, where the shape has an order. */
  readonly slots: readonly Slot[];
  /** Places were given by hand: a new shape proposes none. */
  readonly by_hand: boolean;
}

/** Those of cpp/core/proximity.h for members of one formation. */
export const kLimits: Limits = {
  radius_m: 150,
  height_m: 50,
  d_mod_m: 150,
  advisory_tau_s: 30,
  caution_tau_s: 15,
};
const kSpacing_m = 500;
const kLead_m = 1000;
/** Numbers that travelled as text come back the same; what is typed is coarser than this [m, s]. */
const kSame = 1e-6;

export function draftOf(formation: Formation): Draft {
  const control = isControl(formation.control) ? formation.control : "skein";
  const overrides = Object.fromEntries(formation.parameters.map(({ name, value }) => [name, value]));
  return {
    formation_id: formation.formation_id,
    name: formation.name,
    control,
    gains: { skein: {}, paper: {}, [control]: overrides },
    shape: isShape(formation.shape) ? formation.shape : "custom",
    spacing_m: formation.spacing_m > 0 ? formation.spacing_m : kSpacing_m,
    lead_m: formation.lead_m,
    limits: {
      radius_m: formation.radius_m,
      height_m: formation.height_m,
      d_mod_m: formation.d_mod_m,
      advisory_tau_s: formation.advisory_tau_s,
      caution_tau_s: formation.caution_tau_s,
    },
    slots: formation.slots,
    by_hand: false,
  };
}

export function newDraft(formation_id: number, vehicle_ids: readonly number[]): Draft {
  const none: Draft = {
    formation_id,
    name: `Formation ${formation_id}`,
    control: "skein",
    gains: { skein: {}, paper: {} },
    shape: "triangle",
    spacing_m: kSpacing_m,
    lead_m: kLead_m,
    limits: kLimits,
    slots: [],
    by_hand: false,
  };
  return withMembers(none, vehicle_ids);
}

/** As it is commanded. `hold` belongs to what is flown and is not edited. */
export function bodyOf(draft: Draft, hold = false): FormationBody {
  return {
    formation_id: draft.formation_id,
    name: draft.name,
    control: draft.control,
    shape: draft.shape,
    spacing_m: draft.shape === "custom" ? 0 : draft.spacing_m,
    lead_m: draft.lead_m,
    ...draft.limits,
    hold,
    parameters: overridesOf(draft).map(([name, value]) => ({ name, value })),
    slots: [...draft.slots],
  };
}

function overridesOf(draft: Draft): [string, number][] {
  return Object.entries(draft.gains[draft.control]).sort(([a], [b]) => (a < b ? -1 : 1));
}

/** What is different between two formations, in words for people; empty: they fly the same. Who holds is no difference. */
export function differences(one: FormationBody, other: FormationBody): string[] {
  const near = (a: number, b: number) => Math.abs(a - b) <= kSame;
  const words: string[] = [];
  const note = (different: boolean, word: string) => {
    if (different) words.push(word);
  };
  note(one.name !== other.name, "name");
  note(one.shape !== other.shape, "shape");
  note(one.shape !== "custom" && !near(one.spacing_m, other.spacing_m), "spacing");
  note(!near(one.lead_m, other.lead_m), "lead");
  note(one.control !== other.control, "control law");
  note(!sameNumbers(gainsOf(one), gainsOf(other)) && one.control === other.control, "gains");
  note(!near(one.radius_m, other.radius_m) || !near(one.height_m, other.height_m), "cylinder");
  note(
    !near(one.d_mod_m, other.d_mod_m) ||
      !near(one.advisory_tau_s, other.advisory_tau_s) ||
      !near(one.caution_tau_s, other.caution_tau_s),
    "thresholds",
  );
  const places = new Map(other.slots.map((slot) => [slot.vehicle_id, slot]));
  const moved = one.slots.filter((slot) => {
    const place = places.get(slot.vehicle_id);
    return place !== undefined && !samePlace(slot, place);
  }).length;
  const joined = one.slots.filter((slot) => !places.has(slot.vehicle_id)).length;
  const left = other.slots.length - (one.slots.length - joined);
  note(moved > 0, `${moved} ${moved === 1 ? "place" : "places"}`);
  note(joined > 0, `${joined} more UAV${joined === 1 ? "" : "s"}`);
  note(left > 0, `${left} UAV${left === 1 ? "" : "s"} less`);
  return words;
}

function gainsOf(body: FormationBody): ReadonlyMap<string, number> {
  return new Map(body.parameters.map(({ name, value }) => [name, value]));
}

function sameNumbers(one: ReadonlyMap<string, number>, other: ReadonlyMap<string, number>): boolean {
  return one.size === other.size && [...one].every(([name, value]) => other.get(name) === value);
}

function samePlace(one: Offset, other: Offset): boolean {
  return (
    Math.abs(one.forward_m - other.forward_m) <= kSame &&
    Math.abs(one.left_m - other.left_m) <= kSame &&
    Math.abs(one.up_m - other.up_m) <= kSame
  );
}

/** Slots as the shape wants them; who flies where and how high above the leader stays. */
function shaped(draft: Draft): Draft {
  if (draft.shape === "custom") return draft;
  const places = shapeSlots(draft.shape, draft.slots.length, draft.spacing_m, draft.lead_m);
  const slots = draft.slots.map((slot, i) => ({ ...slot, ...places[i], up_m: slot.up_m }));
  return { ...draft, slots };
}

export function withShape(draft: Draft, shape: Shape | "custom"): Draft {
  return shaped({ ...draft, shape });
}

export function withSpacing(draft: Draft, spacing_m: number): Draft {
  return shaped({ ...draft, spacing_m });
}

/** All slots move along. */
export function withLead(draft: Draft, lead_m: number): Draft {
  const back_m = lead_m - draft.lead_m;
  const slots = draft.slots.map((slot) => ({ ...slot, forward_m: slot.forward_m - back_m }));
  return shaped({ ...draft, lead_m, slots });
}

/** Moves the slots of these UAVs. A slot that leaves its place makes the shape a custom one; height does not. */
export function moved(draft: Draft, vehicle_ids: ReadonlySet<number>, by: Offset): Draft {
  if (by.forward_m === 0 && by.left_m === 0 && by.up_m === 0) return draft;
  const slots = draft.slots.map((slot) =>
    vehicle_ids.has(slot.vehicle_id)
      ? {
          ...slot,
          forward_m: slot.forward_m + by.forward_m,
          left_m: slot.left_m + by.left_m,
          up_m: slot.up_m + by.up_m,
        }
      : slot,
  );
  const level = by.forward_m !== 0 || by.left_m !== 0;
  return { ...draft, slots, shape: level ? "custom" : draft.shape };
}

/** Exchanges who flies in two slots. */
export function swapped(draft: Draft, one_id: number, other_id: number): Draft {
  const exchange = new Map([
    [one_id, other_id],
    [other_id, one_id],
  ]);
  const slots = draft.slots.map((slot) => ({
    ...slot,
    vehicle_id: exchange.get(slot.vehicle_id) ?? slot.vehicle_id,
  }));
  return { ...draft, slots, by_hand: true };
}

/** The same slots, flown by the same UAVs in another order. */
export function withOrder(draft: Draft, vehicle_ids: readonly number[], by_hand: boolean): Draft {
  const slots = draft.slots.map((slot, i) => ({ ...slot, vehicle_id: vehicle_ids[i] ?? slot.vehicle_id }));
  return { ...draft, slots, by_hand };
}

/** Takes UAVs in, at the end: behind the last slot where the shape is custom. */
export function withMembers(draft: Draft, vehicle_ids: readonly number[]): Draft {
  const known = new Set(draft.slots.map((slot) => slot.vehicle_id));
  const hindmost_m = draft.slots.reduce((least, slot) => Math.min(least, slot.forward_m), Infinity);
  const first_m = Number.isFinite(hindmost_m) ? hindmost_m - draft.spacing_m : -draft.lead_m;
  const added = vehicle_ids
    .filter((id) => !known.has(id))
    .map((vehicle_id, i) => ({
      vehicle_id,
      forward_m: first_m - i * draft.spacing_m,
      left_m: 0,
      up_m: 0,
    }));
  return added.length === 0 ? draft : shaped({ ...draft, slots: [...draft.slots, ...added] });
}

export function withoutMember(draft: Draft, vehicle_id: number): Draft {
  return shaped({ ...draft, slots: draft.slots.filter((slot) => slot.vehicle_id !== vehicle_id) });
}

/** A gain of the present law; its preset is no override. */
export function withGain(draft: Draft, name: string, value: number): Draft {
  const others = Object.entries(draft.gains[draft.control]).filter(([other]) => other !== name);
  const preset = kGains[draft.control].find((gain) => gain.name === name)?.preset;
  const overrides = Object.fromEntries(value === preset ? others : [...others, [name, value]]);
  return { ...draft, gains: { ...draft.gains, [draft.control]: overrides } };
}

export function withPresets(draft: Draft): Draft {
  return { ...draft, gains: { ...draft.gains, [draft.control]: {} } };
}

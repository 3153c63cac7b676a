/** Quantities in the units that the person has chosen. SI in, text out, and back from what was typed. */
import { altitude_unit, distance_unit, speed_unit } from "../state/settings";
import { fixed } from "./format";
import { niceStep } from "./nice_step";

const kFoot_m = 0.3048;
const kKnot_m_s = 1852 / 3600;

const kLengths = { m: 1, ft: kFoot_m } as const;
const kSpeeds = { "m/s": 1, "km/h": 1 / 3.6, kt: kKnot_m_s } as const;

export interface Quantity {
  /** "ft": changes with the person's choice; whoever shows it is drawn again. */
  unit(): string;
  /** From SI into the chosen unit. */
  value(si: number): number;
  /** The number alone, for a column whose head names the unit. */
  text(si: number, decimals?: number): string;
  /** Number and unit. */
  full(si: number, decimals?: number): string;
  /** From the chosen unit into SI. */
  toSi(value: number): number;
}

function quantity(unit: () => string, si_per_unit: () => number): Quantity {
  const value = (si: number) => si / si_per_unit();
  const text = (si: number, decimals = 0) => fixed(value(si), decimals);
  return {
    unit,
    value,
    text,
    full: (si, decimals = 0) => `${text(si, decimals)} ${unit()}`,
    toSi: (shown) => shown * si_per_unit(),
  };
}

/** Horizontal distances and errors. */
export const distance = quantity(
  () => distance_unit.value,
  () => kLengths[distance_unit.value],
);

const kMile_m = 1852;

/** The least length of 1, 2 or 5 times a power of ten of the unit it is told in (m and km, or ft and NM) that is not below `least_m` [m]. */
export function roundLength_m(least_m: number): number {
  if (distance_unit.value === "m") return niceStep(least_m);
  const feet = niceStep(least_m / kFoot_m);
  return feet <= 5000 ? feet * kFoot_m : niceStep(least_m / kMile_m) * kMile_m;
}

/** A length on a scale, or a line of a grid, of this step: "500 m", "1.5 km", "2000 ft", "0.5 NM". */
export function lengthInSteps(metres: number, step_m: number): string {
  const [unit, unit_m] =
    distance_unit.value === "m"
      ? metres >= 1000
        ? (["km", 1000] as const)
        : (["m", 1] as const)
      : step_m >= kMile_m * (1 - 1e-9)
        ? (["NM", kMile_m] as const)
        : (["ft", kFoot_m] as const);
  return `${Number((metres / unit_m).toPrecision(9))} ${unit}`;
}

/** A distance that may be long: in kilometres or nautical miles from 10 km or a mile on. */
export function farDistance(metres: number): string {
  if (distance_unit.value === "m")
    return metres < 10_000 ? distance.full(metres) : `${fixed(metres / 1000, 1)} km`;
  return metres < kMile_m ? distance.full(metres) : `${fixed(metres / kMile_m, 1)} NM`;
}

/** An error from a slot, in a column: tenths count while it is small, and a large one must fit. */
export function errorText(of: Quantity, metres: number): string {
  return of.text(metres, Math.abs(of.value(metres)) < 1000 ? 1 : 0);
}

/** Altitudes above the local origin ("ENU") and vertical distances. */
export const altitude = quantity(
  () => altitude_unit.value,
  () => kLengths[altitude_unit.value],
);

export const speed = quantity(
  () => speed_unit.value,
  () => kSpeeds[speed_unit.value],
);

/** What is shown as it is, whatever units the person has chosen: seconds, gains. */
export function inUnit(unit: string): Quantity {
  return quantity(
    () => unit,
    () => 1,
  );
}

export const seconds = inUnit("s");

/** Of shares of one. */
export const percent = quantity(
  () => "%",
  () => 0.01,
);

/** Every altitude is told with what it is measured from: the origin of the local frame. */
export const kAltitudeReference = "ENU";

/** An altitude with unit and reference: "1000 m ENU". */
export function altitudeAbove(up_m: number, decimals = 0): string {
  return `${altitude.full(up_m, decimals)} ${kAltitudeReference}`;
}

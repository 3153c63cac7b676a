/** A place on the map, as people write it down. */
import { forward } from "mgrs";
import { wrapped, type LatLon } from "../units/geodesy";
import { fixed, kNone } from "../units/format";
import { distance } from "../units/quantities";
import type { EnuPoint } from "./map_access";

/** Digits of a degree: about a metre. */
const kDecimals = 5;
/** MGRS covers 80 S to 84 N; the poles have another system. */
const kMgrsSouth_deg = -80;
const kMgrsNorth_deg = 84;

export function latLonText({ latitude_deg, longitude_deg }: LatLon): string {
  const part = (value: number, positive: string, negative: string) =>
    `${Math.abs(value).toFixed(kDecimals)}° ${value < 0 ? negative : positive}`;
  return `${part(latitude_deg, "N", "S")}, ${part(wrapped(longitude_deg), "E", "W")}`;
}

export function enuText(at: EnuPoint | null): string {
  if (at === null) return kNone;
  const unit = distance.unit();
  return `E ${fixed(distance.value(at.east_m))} ${unit}, N ${fixed(distance.value(at.north_m))} ${unit}`;
}

/** "50T MK 64213 36978": to a metre. */
export function mgrsText({ latitude_deg, longitude_deg }: LatLon): string {
  if (latitude_deg < kMgrsSouth_deg || latitude_deg > kMgrsNorth_deg) return kNone;
  const text = forward([wrapped(longitude_deg), latitude_deg], 5);
  const parts = /^(\d+[A-Z])([A-Z]{2})(\d{5})(\d{5})$/.exec(text);
  return parts === null ? text : parts.slice(1).join(" ");
}

/** What is read from a file, and why not. */
import type { LocalFrame } from "../units/geodesy";
import { kFarthest_m, type PathPlan } from "./path_plan";
import type { Waypoint } from "../link/messages";

export interface PathFile extends PathPlan {
  /** What was assumed or left out, for people. */
  notes: string[];
}

/** Why a file can't be taken: names the place in it and what is wrong. */
export class PathFileError extends Error {}

/** What a waypoint gets of which the file doesn't tell. */
export type Defaults = Pick<Waypoint, "up_m" | "speed_m_s">;

/** Degrees and metres above the level of the origin, as places in files are turned into waypoints. */
export interface FilePlace {
  latitude_deg: number;
  longitude_deg: number;
  up_m: number;
}

/**
 * Altitude runs along the up axis of the local frame, so that what has one altitude is flown level; heights above the
 * ellipsoid sink away from it, 8 m in 10 km. The height that belongs to an altitude is found in steps that shrink a
 * thousandfold each.
 */
export function toLocal(frame: LocalFrame, { latitude_deg, longitude_deg, up_m }: FilePlace) {
  let height_m = frame.origin.altitude_m + up_m;
  let at = frame.toEnu(latitude_deg, longitude_deg, height_m);
  for (let i = 0; i < 4; i += 1) {
    height_m += up_m - at.up_m;
    at = frame.toEnu(latitude_deg, longitude_deg, height_m);
  }
  return { east_m: at.east_m, north_m: at.north_m, up_m };
}

/** Whether a path may go there. */
export function isNearby(frame: LocalFrame, place: FilePlace): boolean {
  return greatCircle_m(frame, place) <= kFarthest_m;
}

/** As `toLocal`; refuses what is too far away to be meant, and for the plane. */
export function toLocalNearby(frame: LocalFrame, place: FilePlace, where: string) {
  const distance_m = greatCircle_m(frame, place);
  if (distance_m > kFarthest_m) {
    throw new PathFileError(
      `${where} lies ${Math.round(distance_m / 1000)} km from the fleet's origin; at most ${kFarthest_m / 1000} km can be flown. ` +
        "Is it for another place, or are latitude and longitude swapped?",
    );
  }
  return toLocal(frame, place);
}

function greatCircle_m({ origin }: LocalFrame, place: FilePlace): number {
  const radian = Math.PI / 180;
  const [a, b] = [origin.latitude_deg * radian, place.latitude_deg * radian];
  const across = (place.longitude_deg - origin.longitude_deg) * radian;
  const cosine = Math.sin(a) * Math.sin(b) + Math.cos(a) * Math.cos(b) * Math.cos(across);
  return 6_371_000 * Math.acos(Math.min(Math.max(cosine, -1), 1));
}

/** A number within a range, or a refusal that names the place. */
export function numberWithin(value: unknown, least: number, most: number, where: string): number {
  const number = typeof value === "string" && value.trim() !== "" ? Number(value) : value;
  if (typeof number !== "number" || !Number.isFinite(number)) {
    throw new PathFileError(`${where} must be a number, not ${JSON.stringify(value)}.`);
  }
  if (number < least || number > most) {
    throw new PathFileError(`${where} must be ${least} to ${most}, not ${number}.`);
  }
  return number;
}

export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Rounded as far as a hundredth of a millimetre or so, for people. */
export function rounded(value: number, decimals: number): number {
  return Number(value.toFixed(decimals));
}

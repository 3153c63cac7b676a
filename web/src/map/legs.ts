/** How far it is from one place to another, and which way. */
import { localFrame, type LatLon } from "../units/geodesy";

const kMeanRadius_m = 6371008.8;

export interface Leg {
  length_m: number;
  /** Compass bearing at the start, true north. */
  bearing_rad: number;
}

/**
 * The chord between both on the ellipsoid, bent onto the sphere: for 1,000 km it is off by less than 0.5%, and by nothing to
 * speak of where formations fly.
 */
export function legBetween(from: LatLon, to: LatLon): Leg {
  const frame = localFrame({ ...from, altitude_m: 0 });
  const { east_m, north_m, up_m } = frame.toEnu(to.latitude_deg, to.longitude_deg, 0);
  const chord_m = Math.hypot(east_m, north_m, up_m);
  const bearing_rad = Math.atan2(east_m, north_m);
  return {
    length_m: 2 * kMeanRadius_m * Math.asin(Math.min(1, chord_m / (2 * kMeanRadius_m))),
    bearing_rad: bearing_rad < 0 ? bearing_rad + 2 * Math.PI : bearing_rad,
  };
}

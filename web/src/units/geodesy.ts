/**
 * Local ENU to WGS-84, exact: the plane touches the ellipsoid at the origin.
 * npm has no maintained library for it that takes plain numbers, and this runs for every UAV in every frame.
 */
import type { Origin } from "../link/messages";

const kA_m = 6378137;
const kF = 1 / 298.257223563;
const kB_m = kA_m * (1 - kF);
const kE2 = kF * (2 - kF);
const kSecondE2 = kE2 / (1 - kE2);
const kRadian = Math.PI / 180;

export interface LatLon {
  latitude_deg: number;
  /** Not wrapped: within 180 degrees of the origin's, so that lines across the date line stay whole. */
  longitude_deg: number;
}

/** -180 to 180, however often the map was turned around the world. */
export function wrapped(longitude_deg: number): number {
  return ((((longitude_deg + 180) % 360) + 360) % 360) - 180;
}

export interface Enu {
  east_m: number;
  north_m: number;
  up_m: number;
}

export interface LocalFrame {
  readonly origin: Origin;
  toLatLon(east_m: number, north_m: number, up_m: number): LatLon;
  /** @param height_m above the ellipsoid, as the origin's altitude */
  toEnu(latitude_deg: number, longitude_deg: number, height_m: number): Enu;
}

export function localFrame(origin: Origin): LocalFrame {
  const sin_lat = Math.sin(origin.latitude_deg * kRadian);
  const cos_lat = Math.cos(origin.latitude_deg * kRadian);
  const normal_m = kA_m / Math.sqrt(1 - kE2 * sin_lat * sin_lat);
  // Earth-centred coordinates in the meridian plane of the origin: longitude is then relative to it.
  const origin_x_m = (normal_m + origin.altitude_m) * cos_lat;
  const origin_z_m = (normal_m * (1 - kE2) + origin.altitude_m) * sin_lat;

  function toLatLon(east_m: number, north_m: number, up_m: number): LatLon {
    const x_m = origin_x_m - sin_lat * north_m + cos_lat * up_m;
    const z_m = origin_z_m + cos_lat * north_m + sin_lat * up_m;
    const axis_distance_m = Math.hypot(x_m, east_m);
    // Bowring 1976: below a nanodegree of error within 100 km of the ground.
    const beta = Math.atan2(z_m * kA_m, axis_distance_m * kB_m);
    const latitude = Math.atan2(
      z_m + kSecondE2 * kB_m * Math.sin(beta) ** 3,
      axis_distance_m - kE2 * kA_m * Math.cos(beta) ** 3,
    );
    return {
      latitude_deg: latitude / kRadian,
      longitude_deg: origin.longitude_deg + Math.atan2(east_m, x_m) / kRadian,
    };
  }

  function toEnu(latitude_deg: number, longitude_deg: number, height_m: number): Enu {
    const sin_point = Math.sin(latitude_deg * kRadian);
    const cos_point = Math.cos(latitude_deg * kRadian);
    const longitude = (longitude_deg - origin.longitude_deg) * kRadian;
    const point_normal_m = kA_m / Math.sqrt(1 - kE2 * sin_point * sin_point);
    const axis_distance_m = (point_normal_m + height_m) * cos_point;
    const dx_m = axis_distance_m * Math.cos(longitude) - origin_x_m;
    const dz_m = (point_normal_m * (1 - kE2) + height_m) * sin_point - origin_z_m;
    return {
      east_m: axis_distance_m * Math.sin(longitude),
      north_m: -sin_lat * dx_m + cos_lat * dz_m,
      up_m: cos_lat * dx_m + sin_lat * dz_m,
    };
  }

  return { origin, toLatLon, toEnu };
}

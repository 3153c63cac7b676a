/** From Mercator coordinates (0..1 around the world) to pixels, without an object per point. */
import type { Map as LeafletMap } from "leaflet";
import type { LocalFrame } from "../units/geodesy";

const kTile_px = 256;
const kEquator_m = 2 * Math.PI * 6378137;

/** Where the map looks. */
export interface View {
  /** Pixels around the world. */
  scale_px: number;
  left_px: number;
  top_px: number;
  width_px: number;
  height_px: number;
}

export function viewOf(map: LeafletMap): View {
  const corner = map.getPixelBounds().min ?? { x: 0, y: 0 };
  const size = map.getSize();
  return {
    scale_px: kTile_px * 2 ** map.getZoom(),
    left_px: corner.x,
    top_px: corner.y,
    width_px: size.x,
    height_px: size.y,
  };
}

export const xOf = (view: View, mercator_x: number) => mercator_x * view.scale_px - view.left_px;
export const yOf = (view: View, mercator_y: number) => mercator_y * view.scale_px - view.top_px;

export function mercatorX(longitude_deg: number): number {
  return longitude_deg / 360 + 0.5;
}

export function mercatorY(latitude_deg: number): number {
  const sine = Math.sin((latitude_deg * Math.PI) / 180);
  return 0.5 - Math.log((1 + sine) / (1 - sine)) / (4 * Math.PI);
}

/** Inverse of `mercatorY`. */
export function latitudeOf(mercator_y: number): number {
  return (Math.atan(Math.sinh(Math.PI * (1 - 2 * mercator_y))) * 180) / Math.PI;
}

/** Pixels a metre takes near a latitude. */
export function pixelsPerMetre(view: View, latitude_deg: number): number {
  return view.scale_px / (kEquator_m * Math.cos((latitude_deg * Math.PI) / 180));
}

export interface Pixel {
  x: number;
  y: number;
}

/** A point of the local frame on the screen. */
export function pixelOf(view: View, frame: LocalFrame, east_m: number, north_m: number, up_m: number): Pixel {
  const at = frame.toLatLon(east_m, north_m, up_m);
  return { x: xOf(view, mercatorX(at.longitude_deg)), y: yOf(view, mercatorY(at.latitude_deg)) };
}

/** A line of the local frame as Mercator pairs x, y, x, y...: worked out once, drawn often. */
export function mercatorLine(
  frame: LocalFrame,
  line: readonly (readonly [number, number, number])[],
): Float64Array {
  const out = new Float64Array(2 * line.length);
  line.forEach(([east_m, north_m, up_m], i) => {
    const at = frame.toLatLon(east_m, north_m, up_m);
    out[2 * i] = mercatorX(at.longitude_deg);
    out[2 * i + 1] = mercatorY(at.latitude_deg);
  });
  return out;
}

/** Outlines of land and borders in Mercator coordinates: worked out once, drawn at any zoom. */
import type { Position } from "geojson";
import { mercatorX, mercatorY, type View } from "./view";

/** Beyond, Mercator's map has no end. */
const kNorthernmost_deg = 85.0511;
/** A line is as wide as this at most, so that what lies farther outside can't be seen [px]. */
const kMargin_px = 4;
/** Points that are nearer than this to the one before are left out [px]. */
const kLeastStep_px = 0.75;

/** A ring or a line. */
export interface Outline {
  /** x, y, x, y... */
  points: Float64Array;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export function outlineOf(line: readonly Position[]): Outline {
  const points = new Float64Array(2 * line.length);
  const outline = { points, left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
  line.forEach(([longitude_deg, latitude_deg], i) => {
    const x = mercatorX(longitude_deg);
    const y = mercatorY(Math.max(-kNorthernmost_deg, Math.min(latitude_deg, kNorthernmost_deg)));
    points[2 * i] = x;
    points[2 * i + 1] = y;
    outline.left = Math.min(outline.left, x);
    outline.right = Math.max(outline.right, x);
    outline.top = Math.min(outline.top, y);
    outline.bottom = Math.max(outline.bottom, y);
  });
  return outline;
}

/** Adds what a view shows of an outline to the path of a canvas, wherever the world repeats: it is drawn three times over, so that a fleet at the date line has land on both sides. */
export function trace(path: Pick<CanvasPath, "moveTo" | "lineTo">, outline: Outline, view: View): void {
  const top_px = outline.top * view.scale_px - view.top_px;
  const bottom_px = outline.bottom * view.scale_px - view.top_px;
  if (bottom_px < -kMargin_px || top_px > view.height_px + kMargin_px) return;
  for (const world of [-1, 0, 1]) {
    const left_px = view.left_px - world * view.scale_px;
    const from_px = outline.left * view.scale_px - left_px;
    const to_px = outline.right * view.scale_px - left_px;
    if (to_px < -kMargin_px || from_px > view.width_px + kMargin_px) continue;
    traceOnce(path, outline.points, { ...view, left_px });
  }
}

/** Bits for the sides on which a point lies beyond the view. */
function beyond(view: View, x: number, y: number): number {
  return (
    (x < -kMargin_px ? 1 : x > view.width_px + kMargin_px ? 2 : 0) |
    (y < -kMargin_px ? 4 : y > view.height_px + kMargin_px ? 8 : 0)
  );
}

function traceOnce(path: Pick<CanvasPath, "moveTo" | "lineTo">, points: Float64Array, view: View): void {
  const { scale_px, left_px, top_px } = view;
  let kept_x = points[0] * scale_px - left_px;
  let kept_y = points[1] * scale_px - top_px;
  path.moveTo(kept_x, kept_y);
  // The sides beyond which all points lie since the one kept last, that one included. Such a run and its chord are on the same side of
  // the view, so the chord does as well, for a line and for an area.
  let sides = beyond(view, kept_x, kept_y);
  let [last_x, last_y] = [kept_x, kept_y];
  let left_out = false; // the last one
  for (let i = 2; i < points.length; i += 2) {
    const x = points[i] * scale_px - left_px;
    const y = points[i + 1] * scale_px - top_px;
    const side = beyond(view, x, y);
    const is_near = Math.abs(x - kept_x) < kLeastStep_px && Math.abs(y - kept_y) < kLeastStep_px;
    if (left_out && (sides & side) === 0 && !is_near) {
      path.lineTo(last_x, last_y);
      [kept_x, kept_y] = [last_x, last_y];
      sides = beyond(view, last_x, last_y);
    }
    left_out = (sides & side) !== 0 || is_near;
    if (left_out) {
      sides &= side;
    } else {
      path.lineTo(x, y);
      [kept_x, kept_y] = [x, y];
      sides = side;
    }
    [last_x, last_y] = [x, y];
  }
  if (left_out) path.lineTo(last_x, last_y);
}

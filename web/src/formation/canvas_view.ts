/** Between the leader's frame and the pixels of the small canvas: forward is up, left is left. */
import type { Offset } from "./shapes";

export interface CanvasView {
  /** What is in the middle. */
  forward_m: number;
  left_m: number;
  px_per_m: number;
  width_px: number;
  height_px: number;
}

export interface Point {
  x: number;
  y: number;
}

const kMargin_px = 26;
/** One slot alone, or slots in one place, are shown with this much around [m]. */
const kLeastReach_m = 150;

type Flat = Pick<Offset, "forward_m" | "left_m">;

/** All of these, with `around_m` about each. */
export function fitted(
  offsets: readonly Flat[],
  around_m: number,
  width_px: number,
  height_px: number,
): CanvasView {
  const reach = (values: readonly number[]) => {
    const least = values.reduce((a, b) => Math.min(a, b), Infinity);
    const most = values.reduce((a, b) => Math.max(a, b), -Infinity);
    return Number.isFinite(least)
      ? { middle: (least + most) / 2, half: (most - least) / 2 }
      : { middle: 0, half: 0 };
  };
  const forward = reach(offsets.map(({ forward_m }) => forward_m));
  const left = reach(offsets.map(({ left_m }) => left_m));
  const fit = (half_m: number, size_px: number) =>
    Math.max(size_px / 2 - kMargin_px, 1) / Math.max(half_m + around_m, kLeastReach_m);
  return {
    forward_m: forward.middle,
    left_m: left.middle,
    px_per_m: Math.min(fit(forward.half, height_px), fit(left.half, width_px)),
    width_px,
    height_px,
  };
}

export function toPixel(view: CanvasView, { forward_m, left_m }: Flat): Point {
  return {
    x: view.width_px / 2 - (left_m - view.left_m) * view.px_per_m,
    y: view.height_px / 2 - (forward_m - view.forward_m) * view.px_per_m,
  };
}

export function toOffset(view: CanvasView, { x, y }: Point): Flat {
  return {
    forward_m: view.forward_m + (view.height_px / 2 - y) / view.px_per_m,
    left_m: view.left_m + (view.width_px / 2 - x) / view.px_per_m,
  };
}

/** Closer or farther, with what is at a point staying there. */
export function zoomed(view: CanvasView, factor: number, at: Point): CanvasView {
  const px_per_m = Math.min(Math.max(view.px_per_m * factor, 1e-3), 10);
  const fixed = toOffset(view, at);
  const moved = toOffset({ ...view, px_per_m }, at);
  return {
    ...view,
    px_per_m,
    forward_m: view.forward_m + fixed.forward_m - moved.forward_m,
    left_m: view.left_m + fixed.left_m - moved.left_m,
  };
}

export function panned(view: CanvasView, by: Point): CanvasView {
  return {
    ...view,
    forward_m: view.forward_m + by.y / view.px_per_m,
    left_m: view.left_m + by.x / view.px_per_m,
  };
}

/** To the nearest multiple of a step; 0: not at all. */
export function snapped(value: number, step: number): number {
  return step > 0 ? Math.round(value / step) * step : value;
}

/** The nearest slot within reach of a point. */
export function pick<T extends Flat>(
  view: CanvasView,
  slots: readonly T[],
  at: Point,
  reach_px: number,
): T | null {
  let nearest: T | null = null;
  let nearest_px = reach_px;
  for (const slot of slots) {
    const { x, y } = toPixel(view, slot);
    const away_px = Math.hypot(x - at.x, y - at.y);
    if (away_px <= nearest_px) [nearest, nearest_px] = [slot, away_px];
  }
  return nearest;
}

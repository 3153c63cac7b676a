/** Where times are on the line. */
import type { Span } from "./playing";

export interface Scale extends Span {
  width_px: number;
}

export function xOf({ from_s, to_s, width_px }: Scale, t_s: number): number {
  return ((t_s - from_s) / (to_s - from_s)) * width_px;
}

export function timeOf({ from_s, to_s, width_px }: Scale, x_px: number): number {
  return from_s + (Math.min(Math.max(x_px, 0), width_px) / width_px) * (to_s - from_s);
}

export function secondsPerPixel({ from_s, to_s, width_px }: Scale): number {
  return (to_s - from_s) / width_px;
}

const kTickSteps_s = [
  1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 28_800, 43_200, 86_400,
] as const;
const kTicksApart_px = 84;

/** Round times within the scale, far enough apart for their labels. */
export function ticks(scale: Scale): number[] {
  const least_s = secondsPerPixel(scale) * kTicksApart_px;
  const step_s = kTickSteps_s.find((step) => step >= least_s) ?? Math.ceil(least_s / 86_400) * 86_400;
  const first = Math.ceil(scale.from_s / step_s);
  const last = Math.floor(scale.to_s / step_s);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step_s);
}

/** The part that is seen, moved by whole pages until it holds `t_s`. */
export function spanWith(span: Span, t_s: number, duration_s: number): Span {
  if (t_s >= span.from_s && t_s <= span.to_s) return span;
  const length_s = span.to_s - span.from_s;
  // A little before it is seen, too.
  const from_s = Math.min(Math.max(t_s - 0.1 * length_s, 0), Math.max(duration_s - length_s, 0));
  return { from_s, to_s: from_s + length_s };
}

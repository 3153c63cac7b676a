/** The lines over the map: meridians and parallels far out, the local grid in metres near by. */
import { wrapped, type LocalFrame } from "../units/geodesy";
import { lengthInSteps, roundLength_m } from "../units/quantities";
import type { Colours } from "./colours";
import { latitudeOf, mercatorX, mercatorY, pixelOf, pixelsPerMetre, xOf, yOf, type View } from "./view";

/** Lines are at least this far apart [px]. */
const kLeastGap_px = 84;
const kWidestLocalView_m = 80_000;
const kFarthestFromOrigin_m = 400_000;
const kDegreeSteps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 30];

/** Where labels start: in the gap between the bar at the top and the panels; wholly behind panels at the left. */
const kLabelTop_px = 57;
const kLabelLeft_px = 14;

/** Spacing of the local grid [m] in this view; null where meridians and parallels are drawn instead. */
export function localGridStep_m(view: View, frame: LocalFrame | null): number | null {
  if (frame === null) return null;
  const per_metre = pixelsPerMetre(view, frame.origin.latitude_deg);
  if (view.width_px / per_metre > kWidestLocalView_m) return null;
  const middle = middleOf(view, frame, per_metre);
  if (Math.hypot(middle.east_m, middle.north_m) > kFarthestFromOrigin_m) return null;
  return roundLength_m(kLeastGap_px / per_metre);
}

export function drawGrid(
  context: CanvasRenderingContext2D,
  view: View,
  frame: LocalFrame | null,
  colours: Colours,
): void {
  context.lineWidth = 1;
  context.font = "10.5px 'Inter Variable', sans-serif";
  const step_m = localGridStep_m(view, frame);
  if (frame !== null && step_m !== null) drawLocalGrid(context, view, frame, step_m, colours);
  else drawGraticule(context, view, colours);
}

function middleOf(view: View, frame: LocalFrame, per_metre: number): { east_m: number; north_m: number } {
  const origin = pixelOf(view, frame, 0, 0, 0);
  return {
    east_m: (view.width_px / 2 - origin.x) / per_metre,
    north_m: (origin.y - view.height_px / 2) / per_metre,
  };
}

function drawLocalGrid(
  context: CanvasRenderingContext2D,
  view: View,
  frame: LocalFrame,
  step_m: number,
  colours: Colours,
): void {
  const per_metre = pixelsPerMetre(view, frame.origin.latitude_deg);
  const middle = middleOf(view, frame, per_metre);
  // Half a view more on each side: away from the origin the grid leans against the map's north.
  const east = stepsAround(middle.east_m, view.width_px / per_metre, step_m);
  const north = stepsAround(middle.north_m, view.height_px / per_metre, step_m);
  const [west_m, east_m] = [east.from * step_m, east.to * step_m];
  const [south_m, north_m] = [north.from * step_m, north.to * step_m];
  const label = (value_m: number, positive: string, negative: string) =>
    `${lengthInSteps(Math.abs(value_m), step_m)} ${value_m < 0 ? negative : positive}`;

  // Counted in steps: a sum of steps in feet would miss zero.
  for (let i = east.from; i <= east.to; i += 1) {
    const e = i * step_m;
    const [a, b] = [pixelOf(view, frame, e, south_m, 0), pixelOf(view, frame, e, north_m, 0)];
    line(context, a, b, e === 0 ? colours.map_axis : colours.map_grid);
    const x = a.x + ((kLabelTop_px - a.y) / (b.y - a.y)) * (b.x - a.x);
    text(context, label(e, "E", "W"), x + 4, kLabelTop_px, colours);
  }
  for (let i = north.from; i <= north.to; i += 1) {
    const n = i * step_m;
    const [a, b] = [pixelOf(view, frame, west_m, n, 0), pixelOf(view, frame, east_m, n, 0)];
    line(context, a, b, n === 0 ? colours.map_axis : colours.map_grid);
    const y = a.y + ((kLabelLeft_px - a.x) / (b.x - a.x)) * (b.y - a.y);
    text(context, label(n, "N", "S"), kLabelLeft_px, y - 4, colours);
  }
}

function stepsAround(middle: number, extent: number, step: number): { from: number; to: number } {
  return {
    from: Math.floor((middle - extent) / step),
    to: Math.ceil((middle + extent) / step),
  };
}

function drawGraticule(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
  const per_degree = view.scale_px / 360;
  const step = kDegreeSteps.find((degrees) => degrees * per_degree >= kLeastGap_px) ?? 30;
  const decimals = step < 1 ? 1 : 0;
  const west = (view.left_px / view.scale_px - 0.5) * 360;
  const east = west + view.width_px / per_degree;
  for (let i = Math.ceil(west / step); i * step <= east; i += 1) {
    const x = xOf(view, mercatorX(i * step));
    line(context, { x, y: 0 }, { x, y: view.height_px }, colours.map_grid);
    text(context, degrees(wrapped(i * step), decimals, "E", "W"), x + 4, kLabelTop_px, colours);
  }
  const north = Math.min(latitudeOf(view.top_px / view.scale_px), 84);
  const south = Math.max(latitudeOf((view.top_px + view.height_px) / view.scale_px), -84);
  for (let i = Math.ceil(south / step); i * step <= north; i += 1) {
    const y = yOf(view, mercatorY(i * step));
    line(context, { x: 0, y }, { x: view.width_px, y }, colours.map_grid);
    text(context, degrees(i * step, decimals, "N", "S"), kLabelLeft_px, y - 4, colours);
  }
}

function degrees(value: number, decimals: number, positive: string, negative: string): string {
  const letter = Math.abs(value) < 1e-9 ? "" : value > 0 ? positive : negative;
  return `${Math.abs(value).toFixed(decimals)}°${letter}`;
}

function line(
  context: CanvasRenderingContext2D,
  a: { x: number; y: number },
  b: { x: number; y: number },
  colour: string,
): void {
  context.strokeStyle = colour;
  context.beginPath();
  context.moveTo(a.x, a.y);
  context.lineTo(b.x, b.y);
  context.stroke();
}

function text(context: CanvasRenderingContext2D, what: string, x: number, y: number, colours: Colours): void {
  context.fillStyle = colours.map_text;
  context.fillText(what, x, y);
}

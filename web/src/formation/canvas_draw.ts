/** Draws a draft in the leader's frame: cylinders, slots in identity colours, where the UAVs are, the leader. */
import type { Colours } from "../map/colours";
import { identityOf } from "../map/colours";
import { at as turned, kAircraft, kLeader, kLevelFrames } from "../map/shapes";
import { niceStep } from "../units/nice_step";
import { toOffset, toPixel, type CanvasView, type Point } from "./canvas_view";
import type { Draft } from "./draft";
import type { Offset } from "./shapes";

export interface Picture {
  draft: Draft;
  selection: ReadonlySet<number>;
  /** In one another's cylinder. */
  conflicting: ReadonlySet<number>;
  /** Where UAVs are now, seen from the leader. */
  seen: ReadonlyMap<number, Offset>;
  colours: Colours;
  font: string;
  /** A length as people read it. */
  lengthText: (metres: number) => string;
  /** Of one unit that is shown [m]. */
  unit_m: number;
}

const kDisc_px = 11;
const kDot_px = 5;
const kLeastDot_px = 1.5;
/** Slots closer than this on the screen are dots without numbers. */
const kRoomForNumbers_px = 20;
const kGridLines = 5;
const kWarning = 3;

export function draw(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  context.clearRect(0, 0, view.width_px, view.height_px);
  context.font = `600 11px ${picture.font}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  drawGrid(context, view, picture);
  drawCylinders(context, view, picture);
  drawWays(context, view, picture);
  drawSlots(context, view, picture);
  drawLeader(context, view, picture);
}

function drawGrid(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  const { colours, unit_m } = picture;
  const step_m = niceStep(view.height_px / view.px_per_m / kGridLines / unit_m) * unit_m;
  const first = toOffset(view, { x: 0, y: 0 });
  const last = toOffset(view, { x: view.width_px, y: view.height_px });
  context.lineWidth = 1;
  const rule = (from: Point, to: Point, main: boolean) => {
    context.strokeStyle = main ? colours.map_axis : colours.map_grid;
    line(context, from, to);
  };
  for (let m = Math.ceil(last.left_m / step_m) * step_m; m <= first.left_m; m += step_m) {
    const x = Math.round(toPixel(view, { forward_m: 0, left_m: m }).x) + 0.5;
    rule({ x, y: 0 }, { x, y: view.height_px }, Math.abs(m) < step_m / 2);
  }
  for (let m = Math.ceil(last.forward_m / step_m) * step_m; m <= first.forward_m; m += step_m) {
    const y = Math.round(toPixel(view, { forward_m: m, left_m: 0 }).y) + 0.5;
    rule({ x: 0, y }, { x: view.width_px, y }, Math.abs(m) < step_m / 2);
  }
  context.fillStyle = colours.map_text;
  context.textAlign = "left";
  context.fillText(`Grid ${picture.lengthText(step_m)}`, 8, view.height_px - 10);
  context.textAlign = "center";
}

/** R about each slot: nobody else's may lie inside, unless it is H higher or lower. */
function drawCylinders(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  const { draft, conflicting, colours } = picture;
  const radius_px = draft.limits.radius_m * view.px_per_m;
  for (const slot of draft.slots) {
    const { x, y } = toPixel(view, slot);
    const inside = conflicting.has(slot.vehicle_id);
    context.beginPath();
    context.arc(x, y, radius_px, 0, 2 * Math.PI);
    context.fillStyle = inside ? colours.level[kWarning] : colours.muted;
    context.globalAlpha = inside ? 0.14 : 0.06;
    context.fill();
    context.globalAlpha = inside ? 0.9 : 0.5;
    context.strokeStyle = inside ? colours.level[kWarning] : colours.muted;
    context.lineWidth = 1;
    context.stroke();
  }
  context.globalAlpha = 1;
}

/** From where each UAV is to its slot. */
function drawWays(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  const { draft, seen, colours } = picture;
  for (const slot of draft.slots) {
    const now = seen.get(slot.vehicle_id);
    if (now === undefined) continue;
    const [from, to] = [toPixel(view, now), toPixel(view, slot)];
    if (Math.hypot(from.x - to.x, from.y - to.y) < kDisc_px) continue;
    const colour = identity(colours, slot.vehicle_id);
    context.strokeStyle = colour;
    context.lineWidth = 1.2;
    context.setLineDash([3, 4]);
    line(context, from, to);
    context.setLineDash([]);
    turned(context, from.x, from.y, 0, () => {
      context.scale(0.7, 0.7);
      context.fillStyle = colour;
      context.globalAlpha = 0.75;
      context.fill(kAircraft);
    });
  }
}

function drawSlots(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  const { draft, selection, conflicting, colours } = picture;
  const room_px = roomBetween(draft, view);
  const numbered = room_px >= kRoomForNumbers_px;
  const radius_px = numbered ? kDisc_px : Math.min(kDot_px, Math.max(kLeastDot_px, 0.35 * room_px));
  const rim_px = Math.min(1.5, 0.3 * radius_px);
  for (const slot of draft.slots) {
    const { x, y } = toPixel(view, slot);
    if (conflicting.has(slot.vehicle_id)) {
      turned(context, x, y, 0, () => {
        const frame = kLevelFrames[kWarning];
        if (!numbered) context.scale(0.5, 0.5);
        context.strokeStyle = colours.level[kWarning];
        context.lineWidth = 2.5;
        if (frame) context.stroke(frame);
      });
    }
    context.beginPath();
    context.arc(x, y, radius_px, 0, 2 * Math.PI);
    context.fillStyle = identity(colours, slot.vehicle_id);
    context.fill();
    context.lineWidth = selection.has(slot.vehicle_id) ? 2 * rim_px : rim_px;
    context.strokeStyle = selection.has(slot.vehicle_id) ? colours.text : colours.map_halo;
    context.stroke();
    if (numbered) {
      context.fillStyle = colours.map_halo;
      context.fillText(String(slot.vehicle_id), x, y + 0.5);
    }
  }
}

/** The least distance between slots that follow one another on the screen: a measure that is quick and good enough. */
function roomBetween(draft: Draft, view: CanvasView): number {
  let least_m = Infinity;
  draft.slots.forEach((slot, i) => {
    const before = draft.slots[i - 1];
    if (before === undefined) return;
    const away_m = Math.hypot(slot.forward_m - before.forward_m, slot.left_m - before.left_m);
    least_m = Math.min(least_m, away_m);
  });
  return draft.slots.length > 60 ? least_m * view.px_per_m : Infinity;
}

/** At the edge, with how far it is, when it flies beyond. */
function drawLeader(context: CanvasRenderingContext2D, view: CanvasView, picture: Picture): void {
  const { colours } = picture;
  const there = toPixel(view, { forward_m: 0, left_m: 0 });
  const edge = 14;
  const shown = {
    x: Math.min(Math.max(there.x, edge), view.width_px - edge),
    y: Math.min(Math.max(there.y, edge), view.height_px - edge),
  };
  const beyond_m = Math.hypot(there.x - shown.x, there.y - shown.y) / view.px_per_m;
  context.strokeStyle = colours.text;
  context.lineWidth = 1.6;
  turned(context, shown.x, shown.y, 0, () => {
    context.scale(0.85, 0.85);
    context.stroke(kLeader);
  });
  context.fillStyle = colours.text;
  const room = shown.x < view.width_px - 140;
  context.textAlign = room ? "left" : "right";
  const text = beyond_m > 1 ? `Leader, ${picture.lengthText(beyond_m)} beyond` : "Leader";
  context.fillText(text, shown.x + (room ? 14 : -14), shown.y + 1);
  context.textAlign = "center";
}

function identity(colours: Colours, id: number): string {
  return colours.identity[identityOf(id) - 1] ?? colours.text;
}

function line(context: CanvasRenderingContext2D, from: Point, to: Point): void {
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}

/** The draft on the map: where its slots would be, who would fly to which, and the tracks that were flown ahead. */
import { effect } from "@preact/signals";
import { readColours, identityOf, type Colours } from "../map/colours";
import type { MapAccess } from "../map/map_access";
import { Overlay } from "../map/overlay";
import { at, kAircraft, kSlot } from "../map/shapes";
import { mercatorLine, pixelOf, viewOf, xOf, yOf, type Pixel, type View } from "../map/view";
import { theme } from "../state/settings";
import type { LocalFrame } from "../units/geodesy";
import type { FormationEditor } from "./editor";
import type { FlownAhead, Track } from "./preview";

const kMoves = "move zoom resize";
/** Nearer than this a UAV is in its slot, and no line leads there. */
const kInSlot_px = 14;

export class GhostLayer {
  private readonly overlay: Overlay;
  private readonly stop: () => void;
  private colours: Colours = readColours();
  /** The frame of the screen that is waited for, 0: none. */
  private waiting = 0;
  /** Tracks in the map's coordinates, worked out once. */
  private lines: { of: FlownAhead; frame: LocalFrame; tracks: Map<number, Float64Array> } | null = null;

  constructor(
    private readonly map: MapAccess,
    private readonly editor: FormationEditor,
  ) {
    this.overlay = new Overlay(map.leaflet, "ghosts");
    map.leaflet.on(kMoves, this.want);
    const stops = [
      theme.subscribe(() => {
        this.colours = readColours();
        this.want();
      }),
      effect(() => {
        // Whatever of these changes, the picture does.
        void editor.station.store.now_ms.value;
        void editor.session.value?.draft.value;
        void editor.looked_at_s.value;
        void editor.preview.state.value;
        this.want();
      }),
    ];
    this.stop = () => {
      for (const stop of stops) stop();
    };
  }

  remove(): void {
    this.stop();
    cancelAnimationFrame(this.waiting);
    this.map.leaflet.off(kMoves, this.want);
    this.overlay.remove();
  }

  /** Draws once a frame of the screen, however much has changed. */
  private readonly want = (): void => {
    if (this.waiting === 0) this.waiting = requestAnimationFrame(this.draw);
  };

  private readonly draw = (): void => {
    this.waiting = 0;
    const view = viewOf(this.map.leaflet);
    const context = this.overlay.begin(view);
    const frame = this.map.frame();
    const session = this.editor.session.peek();
    if (frame === null || session === null || !session.changed.peek()) return;
    const preview = this.editor.preview.state.peek();
    if (preview.kind === "done" && preview.result.ok) this.drawTracks(context, view, frame, preview.result);
    this.drawSlots(context, view, frame);
  };

  private drawSlots(context: CanvasRenderingContext2D, view: View, frame: LocalFrame): void {
    const now_ms = performance.now();
    const ground = this.editor.ground(now_ms);
    const draft = this.editor.session.peek()?.draft.peek();
    if (ground === null || draft === undefined) return;
    const pixel = (place: { east_m: number; north_m: number; up_m: number }) =>
      pixelOf(view, frame, place.east_m, place.north_m, place.up_m);
    for (const slot of draft.slots) {
      const to = pixel(ground.place(slot));
      const flying = this.editor.flying(slot.vehicle_id, now_ms);
      context.strokeStyle = this.colourOf(slot.vehicle_id);
      context.lineWidth = 1.5;
      if (flying !== null) {
        const from = pixel(flying);
        if (Math.hypot(from.x - to.x, from.y - to.y) > kInSlot_px) {
          context.setLineDash([8, 5]);
          line(context, from, to);
          context.setLineDash([]);
        }
      }
      at(context, to.x, to.y, 0, () => {
        context.lineWidth = 2.5;
        context.stroke(kSlot);
        context.globalAlpha = 0.22;
        context.fillStyle = this.colourOf(slot.vehicle_id);
        context.fill(kSlot);
        context.globalAlpha = 1;
      });
    }
  }

  private drawTracks(
    context: CanvasRenderingContext2D,
    view: View,
    frame: LocalFrame,
    result: FlownAhead,
  ): void {
    const at_s = this.editor.looked_at_s.peek();
    for (const track of result.tracks) {
      const points = this.tracksOf(result, frame).get(track.id);
      if (points === undefined) continue;
      context.strokeStyle = this.colourOf(track.id);
      context.lineWidth = 1.5;
      context.globalAlpha = 0.7;
      context.beginPath();
      for (let i = 0; i < points.length; i += 2) {
        context.lineTo(xOf(view, points[i]), yOf(view, points[i + 1]));
      }
      context.stroke();
      context.globalAlpha = 1;
      if (at_s > 0) this.drawThen(context, view, frame, track, at_s);
    }
  }

  /** The UAV as it would be then, hollow: it is not there. */
  private drawThen(
    context: CanvasRenderingContext2D,
    view: View,
    frame: LocalFrame,
    track: Track,
    at_s: number,
  ): void {
    const then = placeAt(track, at_s);
    if (then === null) return;
    const { x, y } = pixelOf(view, frame, then.east_m, then.north_m, then.up_m);
    at(context, x, y, Math.PI / 2 - then.course_rad, () => {
      context.fillStyle = this.colours.map_halo;
      context.fill(kAircraft);
      context.strokeStyle = this.colourOf(track.id);
      context.lineWidth = 1.6;
      context.stroke(kAircraft);
    });
  }

  private tracksOf(result: FlownAhead, frame: LocalFrame): Map<number, Float64Array> {
    if (this.lines?.of !== result || this.lines.frame !== frame) {
      const tracks = result.tracks.map(({ id, points }) => {
        const enu = points.map(([, east, north, up]) => [east, north, up] as const);
        return [id, mercatorLine(frame, enu)] as const;
      });
      this.lines = { of: result, frame, tracks: new Map(tracks) };
    }
    return this.lines.tracks;
  }

  private colourOf(id: number): string {
    return this.colours.identity[identityOf(id) - 1] ?? this.colours.text;
  }
}

/** Where a track is at a time, between its points; its course is that of the piece. */
export function placeAt(
  { points }: Track,
  t_s: number,
): { east_m: number; north_m: number; up_m: number; course_rad: number } | null {
  const after = points.findIndex(([t]) => t >= t_s);
  const i = after < 0 ? points.length - 1 : Math.max(after, 1);
  const [from, to] = [points[i - 1], points[i]];
  if (from === undefined || to === undefined) return null;
  const share = to[0] > from[0] ? Math.min((t_s - from[0]) / (to[0] - from[0]), 1) : 0;
  return {
    east_m: from[1] + share * (to[1] - from[1]),
    north_m: from[2] + share * (to[2] - from[2]),
    up_m: from[3] + share * (to[3] - from[3]),
    course_rad: Math.atan2(to[2] - from[2], to[1] - from[1]),
  };
}

function line(context: CanvasRenderingContext2D, from: Pixel, to: Pixel): void {
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}

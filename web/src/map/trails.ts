/** Where each UAV has been: a ring of Mercator points per id. */
import type { Fleet } from "../state/fleet";
import type { LocalFrame } from "../units/geodesy";
import { mercatorX, mercatorY, xOf, yOf, type View } from "./view";

const kInterval_us = 1_000_000;
const kPoints = 240;
/** Points nearer than this to one another look like one [px]. */
const kLeastStep_px = 4;

interface Ring {
  points: Float64Array;
  /** Points written so far; the newest is at (written - 1) % kPoints. */
  written: number;
  last_utime: number;
}

export class Trails {
  private readonly rings = new Map<number, Ring>();

  clear(): void {
    this.rings.clear();
  }

  /** Takes the newest positions, one a second. */
  sample(fleet: Fleet, frame: LocalFrame): void {
    const motion = fleet.motion;
    if (motion === null) return;
    for (let row = 0; row < motion.count; row += 1) {
      const id = motion.id[row];
      const heard_utime = motion.utime - motion.age_s[row] * 1e6;
      let ring = this.rings.get(id);
      if (ring === undefined) {
        ring = { points: new Float64Array(2 * kPoints), written: 0, last_utime: -Infinity };
        this.rings.set(id, ring);
      }
      if (heard_utime - ring.last_utime < kInterval_us) continue;
      const place = frame.toLatLon(motion.east_m[row], motion.north_m[row], motion.up_m[row]);
      const slot = ring.written % kPoints;
      ring.points[2 * slot] = mercatorX(place.longitude_deg);
      ring.points[2 * slot + 1] = mercatorY(place.latitude_deg);
      ring.written += 1;
      ring.last_utime = heard_utime;
    }
  }

  /** Draws all trails, older parts fainter. */
  draw(context: CanvasRenderingContext2D, view: View, colourOf: (id: number) => string): void {
    context.lineWidth = 2;
    context.lineJoin = "round";
    for (const [id, ring] of this.rings) {
      context.strokeStyle = colourOf(id);
      const oldest = Math.max(0, ring.written - kPoints);
      const length = ring.written - oldest;
      for (let part = 0; part < 3; part += 1) {
        context.globalAlpha = [0.18, 0.35, 0.6][part] ?? 0.6;
        const from = oldest + Math.floor((length * part) / 3);
        const to = Math.min(ring.written - 1, oldest + Math.floor((length * (part + 1)) / 3));
        context.beginPath();
        let [last_x, last_y] = [Infinity, Infinity];
        for (let i = from; i <= to; i += 1) {
          const slot = i % kPoints;
          const x = xOf(view, ring.points[2 * slot]);
          const y = yOf(view, ring.points[2 * slot + 1]);
          if (i < to && Math.abs(x - last_x) + Math.abs(y - last_y) < kLeastStep_px) continue;
          context.lineTo(x, y);
          [last_x, last_y] = [x, y];
        }
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  /** The newest point of a trail, from which the fleet's layer draws on to the symbol. */
  newest(id: number, view: View): { x: number; y: number } | null {
    const ring = this.rings.get(id);
    if (ring === undefined || ring.written === 0) return null;
    const slot = (ring.written - 1) % kPoints;
    return { x: xOf(view, ring.points[2 * slot]), y: yOf(view, ring.points[2 * slot + 1]) };
  }
}

/** Where each UAV has been, for half an hour: Mercator points, few where it flies straight. */
import type { Fleet } from "../state/fleet";
import type { LocalFrame } from "../units/geodesy";
import { kIdentities } from "./colours";
import { mercatorX, mercatorY, xOf, yOf, type Pixel, type View } from "./view";

const kShortest_us = 1_000_000;
/** A straight flight has a point this often. */
const kLongest_us = 10_000_000;
/** Points further apart than this have a time between them in which nothing was heard: nobody knows what it flew then. */
const kGap_us = kLongest_us + 4_000_000;
const kTurned_rad = 0.03;
export const kLongestTrail_min = 30;
/** Points nearer than this to one another look like one [px]. */
const kLeastStep_px = 4;
/** Older parts are fainter. */
const kAlphas = [0.18, 0.35, 0.6] as const;

interface Trail {
  /** Mercator x, y of each point. */
  points: number[];
  utimes: number[];
  course_rad: number;
}

export class Trails {
  private readonly by_id = new Map<number, Trail>();
  private sampled_utime = 0;

  clear(): void {
    this.by_id.clear();
    this.sampled_utime = 0;
  }

  /** Takes the newest positions. */
  sample(fleet: Fleet, frame: LocalFrame): void {
    const motion = fleet.motion;
    if (motion === null || motion.utime === this.sampled_utime) return;
    this.sampled_utime = motion.utime;
    for (let row = 0; row < motion.count; row += 1) {
      const id = motion.id[row];
      const heard_utime = motion.utime - motion.age_s[row] * 1e6;
      let trail = this.by_id.get(id);
      if (trail === undefined) {
        trail = { points: [], utimes: [], course_rad: 0 };
        this.by_id.set(id, trail);
      }
      forgetAfter(trail, heard_utime);
      const since_us = heard_utime - (trail.utimes.at(-1) ?? -Infinity);
      const course_rad = motion.course_rad[row];
      const turned = Math.abs(Math.sin((course_rad - trail.course_rad) / 2)) * 2 > kTurned_rad;
      if (since_us < kShortest_us || (since_us < kLongest_us && !turned)) continue;
      const place = frame.toLatLon(motion.east_m[row], motion.north_m[row], motion.up_m[row]);
      trail.points.push(mercatorX(place.longitude_deg), mercatorY(place.latitude_deg));
      trail.utimes.push(heard_utime);
      trail.course_rad = course_rad;
      forgetBefore(trail, heard_utime - kLongestTrail_min * 60e6);
    }
  }

  /** Draws the trails of those UAVs, a path for each colour and age: strokes cost more than their points. */
  draw(
    context: CanvasRenderingContext2D,
    view: View,
    shown: { ids: Iterable<number>; length_min: number },
    identityOf: (id: number) => number,
    colours: readonly string[],
  ): void {
    const now_utime = this.sampled_utime;
    const length_us = shown.length_min * 60e6;
    const paths = Array.from({ length: kIdentities * kAlphas.length }, () => new Path2D());
    for (const id of shown.ids) {
      const trail = this.by_id.get(id);
      if (trail === undefined) continue;
      const first = firstAfter(trail.utimes, now_utime - length_us);
      this.trace(view, trail, first, (i) => {
        const age = Math.min(Math.max((now_utime - (trail.utimes[i] ?? 0)) / length_us, 0), 0.999);
        const part = kAlphas.length - 1 - Math.floor(age * kAlphas.length);
        return paths[(identityOf(id) - 1) * kAlphas.length + part];
      });
    }
    context.lineWidth = 2;
    context.lineJoin = "round";
    paths.forEach((path, i) => {
      context.globalAlpha = kAlphas[i % kAlphas.length] ?? 1;
      context.strokeStyle = colours[Math.floor(i / kAlphas.length)] ?? "";
      context.stroke(path);
    });
    context.globalAlpha = 1;
  }

  /** The newest point of a trail, from which the fleet's layer draws on to the symbol. */
  newest(id: number, view: View): Pixel | null {
    const points = this.by_id.get(id)?.points;
    if (points === undefined || points.length === 0) return null;
    return { x: xOf(view, points[points.length - 2] ?? 0), y: yOf(view, points[points.length - 1] ?? 0) };
  }

  /** Lines from the point `first` on, each in the path of where it ends. */
  private trace(view: View, trail: Trail, first: number, pathAt: (i: number) => Path2D | undefined): void {
    const last = trail.utimes.length - 1;
    let path: Path2D | undefined;
    let [last_x, last_y] = [0, 0];
    for (let i = first; i <= last; i += 1) {
      const x = xOf(view, trail.points[2 * i] ?? 0);
      const y = yOf(view, trail.points[2 * i + 1] ?? 0);
      if (i > first) {
        const gap = (trail.utimes[i] ?? 0) - (trail.utimes[i - 1] ?? 0) > kGap_us;
        if (!gap && i < last && Math.abs(x - last_x) + Math.abs(y - last_y) < kLeastStep_px) continue;
        const next = gap ? undefined : pathAt(i);
        if (next !== path) next?.moveTo(last_x, last_y);
        path = next;
        path?.lineTo(x, y);
      }
      [last_x, last_y] = [x, y];
    }
  }
}

/** A recording may be wound back. */
function forgetAfter(trail: Trail, utime: number): void {
  while ((trail.utimes.at(-1) ?? -Infinity) > utime) {
    trail.utimes.pop();
    trail.points.length -= 2;
  }
}

function forgetBefore(trail: Trail, before_utime: number): void {
  const old = firstAfter(trail.utimes, before_utime);
  // In one go now and then: taking from the front moves all the rest.
  if (old < 64) return;
  trail.utimes.splice(0, old);
  trail.points.splice(0, 2 * old);
}

/** Index of the first time that is not before `utime`. */
export function firstAfter(utimes: readonly number[], utime: number): number {
  let [low, high] = [0, utimes.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((utimes[middle] ?? 0) < utime) low = middle + 1;
    else high = middle;
  }
  return low;
}

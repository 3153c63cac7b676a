/**
 * Bulk telemetry: the newest frames, as they came, outside the reactive state.
 * Views look UAVs up by id and read the columns; they are told when to look by the map's frame clock or by the store's beat.
 */
import type { Frame, MotionFrame, StatusFrame } from "../link/frames";
import { Pace, type Moment } from "./pace";

const kEmpty = new Map<number, number>();

/** After this long without news, what moves is no longer carried forward. */
const kLongestExtrapolation_s = 2;

export const kLinkUp = 0;
export const kLinkLate = 1;
export const kLinkLost = 2;

export interface Place {
  east_m: number;
  north_m: number;
  up_m: number;
}

export class Fleet {
  motion: MotionFrame | null = null;
  status: StatusFrame | null = null;
  /** How time on the bus goes on between frames. */
  readonly pace = new Pace();
  /** When news came. */
  private arrival: Moment = this.pace.moment(0);
  private status_arrival = this.arrival;
  private motion_rows: ReadonlyMap<number, number> = kEmpty;
  private status_rows: ReadonlyMap<number, number> = kEmpty;

  take(frame: Frame, now_ms: number): void {
    if (frame.kind === "motion") {
      this.motion_rows = rowsOf(frame.id, this.motion?.id, this.motion_rows);
      // A frame with the time of the one before says that the bus is silent, not that it was heard.
      if (frame.utime !== this.motion?.utime) this.arrival = this.pace.moment(now_ms);
      this.motion = frame;
    } else {
      this.status_rows = rowsOf(frame.id, this.status?.id, this.status_rows);
      this.status = frame;
      this.status_arrival = this.pace.moment(now_ms);
    }
  }

  clear(): void {
    this.motion = null;
    this.status = null;
    this.motion_rows = kEmpty;
    this.status_rows = kEmpty;
  }

  /** Row of a UAV in the columns of `motion`, -1: not there. */
  motionRow(id: number): number {
    return this.motion_rows.get(id) ?? -1;
  }

  /** Row of a UAV in the columns of `status`, -1: not there. */
  statusRow(id: number): number {
    return this.status_rows.get(id) ?? -1;
  }

  /** No news of this UAV: what is shown of it is old. */
  isLost(id: number): boolean {
    const row = this.statusRow(id);
    return row >= 0 && this.status !== null && this.status.downlink[row] === kLinkLost;
  }

  /** For how long time on the bus has gone on since the newest motion [ms]; negative when it goes backwards. */
  sinceMotion_ms(now_ms: number): number {
    return this.pace.since_ms(this.arrival, now_ms);
  }

  /** For how long what was so at `utime` is to be carried forward [s]. */
  since_s(utime: number, now_ms: number): number {
    const before_frame_s = ((this.motion?.utime ?? utime) - utime) / 1e6;
    const since_s = before_frame_s + this.sinceMotion_ms(now_ms) / 1000;
    return Math.min(Math.max(since_s, -kLongestExtrapolation_s), kLongestExtrapolation_s);
  }

  /** Time since a UAV was last heard [s], which goes on between frames; -1: never, or not known. */
  downlinkAge_s(id: number, now_ms: number): number {
    return this.carriedOn(this.status?.downlink_age_s[this.statusRow(id)], now_ms);
  }

  /** Time since a UAV last obeyed [s], while commands are sent; -1: not known. */
  uplinkAge_s(id: number, now_ms: number): number {
    return this.carriedOn(this.status?.uplink_age_s[this.statusRow(id)], now_ms);
  }

  private carriedOn(age_s: number | undefined, now_ms: number): number {
    if (age_s === undefined || age_s < 0) return -1;
    return Math.max(0, age_s + this.pace.since_ms(this.status_arrival, now_ms) / 1000);
  }

  /**
   * Where the UAV in a row of `motion` is at `now_ms`: carried along its velocity since it was heard; one that is lost, since
   * the monitor told where it thinks that it is.
   */
  placeAt(row: number, now_ms: number): Place {
    const motion = this.motion;
    if (motion === null) return { east_m: 0, north_m: 0, up_m: 0 };
    const { status } = this;
    const s = this.statusRow(motion.id[row]);
    const lost = status !== null && s >= 0 && status.downlink[s] === kLinkLost;
    const told_utime = lost ? status.utime : motion.utime - motion.age_s[row] * 1e6;
    const way_m = motion.speed_m_s[row] * this.since_s(told_utime, now_ms);
    const level_m = way_m * Math.cos(motion.climb_rad[row]);
    const east_m = level_m * Math.cos(motion.course_rad[row]);
    const north_m = level_m * Math.sin(motion.course_rad[row]);
    if (lost)
      return {
        east_m: status.estimated_east_m[s] + east_m,
        north_m: status.estimated_north_m[s] + north_m,
        // The monitor takes one that hears nothing for flying level.
        up_m: status.estimated_up_m[s],
      };
    return {
      east_m: motion.east_m[row] + east_m,
      north_m: motion.north_m[row] + north_m,
      up_m: motion.up_m[row] + way_m * Math.sin(motion.climb_rad[row]),
    };
  }
}

/** The index of `ids`; that of the frame before, when they are the same. */
function rowsOf(
  ids: Int32Array,
  before: Int32Array | undefined,
  rows: ReadonlyMap<number, number>,
): ReadonlyMap<number, number> {
  if (before?.length === ids.length && ids.every((id, i) => id === before[i])) return rows;
  return new Map([...ids].map((id, row) => [id, row]));
}

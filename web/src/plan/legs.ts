/** Legs of a path: as straight lines, known at once, or as the server says they are flown. */
import type { Waypoint } from "../link/messages";
import type { PathPreview } from "./preview";
import { legEnds, type PathPlan } from "./path_plan";

export interface FlownLeg {
  /** Index of a waypoint; null: from where the leader is. */
  from: number | null;
  to: number;
  length_m: number;
  /** Counter-clockwise from east, from the one point straight to the other. */
  course_rad: number;
  time_s: number;
  /** When its end is reached, counted from the first leg's start. */
  arrival_s: number;
}

/** From waypoint to waypoint in straight lines. */
export function straightLegs(plan: PathPlan): FlownLeg[] {
  return withArrivals(
    legEnds(plan).flatMap(([from, to]) => {
      const [start, end] = [plan.waypoints[from], plan.waypoints[to]];
      return start === undefined || end === undefined ? [] : [{ from, to, ...between(start, end) }];
    }),
  );
}

export function flownLegs({ legs }: PathPreview): FlownLeg[] {
  return withArrivals(legs);
}

export function totalsOf(legs: readonly FlownLeg[]): { length_m: number; time_s: number } {
  return {
    length_m: legs.reduce((sum, { length_m }) => sum + length_m, 0),
    time_s: legs.reduce((sum, { time_s }) => sum + time_s, 0),
  };
}

/** The speed changes evenly with time, so its mean is that of both ends. */
function between(start: Waypoint, end: Waypoint) {
  const length_m = Math.hypot(end.east_m - start.east_m, end.north_m - start.north_m);
  const mean_speed_m_s = (start.speed_m_s + end.speed_m_s) / 2;
  return {
    length_m,
    course_rad: Math.atan2(end.north_m - start.north_m, end.east_m - start.east_m),
    time_s: length_m / mean_speed_m_s,
  };
}

function withArrivals(legs: readonly Omit<FlownLeg, "arrival_s">[]): FlownLeg[] {
  let arrival_s = 0;
  return legs.map((leg) => {
    arrival_s += leg.time_s;
    return { ...leg, arrival_s };
  });
}

/** Legs of a path as straight lines between waypoints, known at once; the server's flight along the arcs refines them. */
import type { Waypoint } from "../link/messages";
import { legEnds, type PathPlan } from "./path_plan";

export interface Leg {
  from: number;
  to: number;
  /** Horizontal, from waypoint to waypoint. */
  length_m: number;
  /** Counter-clockwise from east. */
  course_rad: number;
  climb_m: number;
  time_s: number;
}

export function legsOf(plan: PathPlan): Leg[] {
  return legEnds(plan).flatMap(([from, to]) => {
    const [start, end] = [plan.waypoints[from], plan.waypoints[to]];
    return start === undefined || end === undefined ? [] : [{ from, to, ...legBetween(start, end) }];
  });
}

/** From one place to another; the speed changes evenly with time, so its mean is that of both ends. */
export function legBetween(start: Waypoint, end: Waypoint): Omit<Leg, "from" | "to"> {
  const length_m = Math.hypot(end.east_m - start.east_m, end.north_m - start.north_m);
  const mean_speed_m_s = (start.speed_m_s + end.speed_m_s) / 2;
  return {
    length_m,
    course_rad: Math.atan2(end.north_m - start.north_m, end.east_m - start.east_m),
    climb_m: end.up_m - start.up_m,
    time_s: mean_speed_m_s > 0 ? length_m / mean_speed_m_s : 0,
  };
}

export interface Totals {
  length_m: number;
  time_s: number;
  climb_m: number;
  descent_m: number;
}

export function totalsOf(legs: readonly Leg[]): Totals {
  const totals = { length_m: 0, time_s: 0, climb_m: 0, descent_m: 0 };
  for (const leg of legs) {
    totals.length_m += leg.length_m;
    totals.time_s += leg.time_s;
    if (leg.climb_m > 0) totals.climb_m += leg.climb_m;
    else totals.descent_m -= leg.climb_m;
  }
  return totals;
}

/** Seconds from now at which each waypoint is passed, when the first one is `to_first_s` away. */
export function arrivals_s(count: number, legs: readonly Leg[], to_first_s: number): number[] {
  const arrivals = Array.from({ length: count }, () => to_first_s);
  for (const leg of legs) {
    if (leg.to > leg.from) arrivals[leg.to] = (arrivals[leg.from] ?? 0) + leg.time_s;
  }
  return arrivals;
}

/** A path as it is planned: waypoints and whether they are flown round and round. Values: every edit gives a new one. */
import type { Waypoint } from "../link/messages";

export interface PathPlan {
  readonly closed: boolean;
  /** None: straight on. */
  readonly waypoints: readonly Waypoint[];
}

export interface Place {
  east_m: number;
  north_m: number;
}

export const kStraightOn: PathPlan = { closed: false, waypoints: [] };

/** The bridge takes metres and metres per second within these. */
export const kAltitudeRange_m = { least: -1000, most: 20_000 } as const;
export const kSpeedRange_m_s = { least: 1, most: 400 } as const;
export const kRadiusRange_m = { least: 0, most: 100_000 } as const;
/** Beyond it the local plane is no map of the ground any more. */
export const kFarthest_m = 200_000;
export const kMostWaypoints = 1000;

export function leastWaypoints(closed: boolean): number {
  return closed ? 3 : 2;
}

/** Waypoints that the legs connect, as pairs of indices; the last one of a loop leads back to the first. */
export function legEnds(plan: PathPlan): [from: number, to: number][] {
  const count = plan.waypoints.length;
  if (count < 2) return [];
  const legs = plan.closed && count > 2 ? count : count - 1;
  return Array.from({ length: legs }, (_, i) => [i, (i + 1) % count]);
}

export function insertWaypoint(plan: PathPlan, index: number, waypoint: Waypoint): PathPlan {
  return { ...plan, waypoints: plan.waypoints.toSpliced(index, 0, waypoint) };
}

export function removeWaypoint(plan: PathPlan, index: number): PathPlan {
  const waypoints = plan.waypoints.toSpliced(index, 1);
  return { closed: plan.closed && waypoints.length >= leastWaypoints(true), waypoints };
}

export function changeWaypoint(plan: PathPlan, index: number, change: Partial<Waypoint>): PathPlan {
  return { ...plan, waypoints: plan.waypoints.map((old, i) => (i === index ? { ...old, ...change } : old)) };
}

export function changeAll(plan: PathPlan, change: Partial<Waypoint>): PathPlan {
  return { ...plan, waypoints: plan.waypoints.map((old) => ({ ...old, ...change })) };
}

/** The same ground the other way round; a loop keeps its first waypoint. */
export function reversed(plan: PathPlan): PathPlan {
  const [first, ...rest] = plan.waypoints;
  if (first === undefined) return plan;
  const waypoints = plan.closed ? [first, ...rest.reverse()] : plan.waypoints.toReversed();
  return { ...plan, waypoints };
}

export function moved(plan: PathPlan, east_m: number, north_m: number, up_m = 0): PathPlan {
  return {
    ...plan,
    waypoints: plan.waypoints.map((old) => ({
      ...old,
      east_m: old.east_m + east_m,
      north_m: old.north_m + north_m,
      up_m: old.up_m + up_m,
    })),
  };
}

export function centreOf(plan: PathPlan): Place {
  const count = Math.max(plan.waypoints.length, 1);
  return {
    east_m: plan.waypoints.reduce((sum, { east_m }) => sum + east_m, 0) / count,
    north_m: plan.waypoints.reduce((sum, { north_m }) => sum + north_m, 0) / count,
  };
}

/** Turned about its centre; clockwise, as on a compass. */
export function rotated(plan: PathPlan, clockwise_rad: number): PathPlan {
  const centre = centreOf(plan);
  const [sine, cosine] = [Math.sin(clockwise_rad), Math.cos(clockwise_rad)];
  return {
    ...plan,
    waypoints: plan.waypoints.map((old) => {
      const east_m = old.east_m - centre.east_m;
      const north_m = old.north_m - centre.north_m;
      return {
        ...old,
        east_m: centre.east_m + cosine * east_m + sine * north_m,
        north_m: centre.north_m - sine * east_m + cosine * north_m,
      };
    }),
  };
}

/** Halfway between two waypoints, with their mean altitude and speed and no turn radius of its own. */
export function midway(from: Waypoint, to: Waypoint): Waypoint {
  return {
    east_m: (from.east_m + to.east_m) / 2,
    north_m: (from.north_m + to.north_m) / 2,
    up_m: (from.up_m + to.up_m) / 2,
    speed_m_s: (from.speed_m_s + to.speed_m_s) / 2,
    turn_radius_m: 0,
  };
}

/** Altitude over distance: what the profile shows. */
import type { FlownLeg } from "./legs";
import type { PathPlan } from "./path_plan";

export interface ProfilePoint {
  along_m: number;
  up_m: number;
}

export interface Profile {
  line: ProfilePoint[];
  /** Of each waypoint, in the order of the plan. */
  waypoints: ProfilePoint[];
}

type Line = readonly (readonly [number, number, number])[];

/** The server's line begins so far behind the leader (cpp/bridge/README.md). */
const kBehindLeader_m = 3000;

/** From the leader along the path as it is flown, or, while that isn't known, from the first waypoint along straight legs. */
export function profileOf({ closed, waypoints }: PathPlan, legs: readonly FlownLeg[], flown: Line): Profile {
  const arrivals = distancesOf(legs);
  const points = waypoints.map(({ up_m }, i) => ({ along_m: arrivals.get(i) ?? 0, up_m }));
  if (flown.length > 1) {
    const line = measured(flown).map(({ along_m, up_m }) => ({ along_m: along_m - kBehindLeader_m, up_m }));
    return { line: line.filter(({ along_m }) => along_m >= 0), waypoints: points };
  }
  const [first, last] = [points[0], legs.at(-1)];
  const home = closed && first !== undefined && last?.to === 0;
  const length_m = legs.reduce((sum, leg) => sum + leg.length_m, 0);
  return { line: home ? [...points, { ...first, along_m: length_m }] : points, waypoints: points };
}

/** How far it is to each waypoint when it is first passed. */
function distancesOf(legs: readonly FlownLeg[]): ReadonlyMap<number, number> {
  const distances = new Map<number, number>();
  let along_m = 0;
  for (const { from, to, length_m } of legs) {
    if (from !== null && !distances.has(from)) distances.set(from, along_m);
    along_m += length_m;
    if (!distances.has(to)) distances.set(to, along_m);
  }
  return distances;
}

function measured(line: Line): ProfilePoint[] {
  let along_m = 0;
  return line.map(([east_m, north_m, up_m], i) => {
    const before = line[i - 1];
    if (before !== undefined) along_m += Math.hypot(east_m - before[0], north_m - before[1]);
    return { along_m, up_m };
  });
}

/** Where slots lie on the map: behind the leader's nose, or along its path. */
import type { FormationStatus, Path } from "../link/messages";
import type { Place } from "../state/fleet";
import type { Control } from "./gains";
import type { Offset } from "./shapes";

export interface Leader extends Place {
  course_rad: number;
}

export type Placing = (offset: Offset) => Place;

/** In the leader's own frame, as control "paper" flies: eq. (6) with x forward and y left. */
export function rigid(leader: Leader): Placing {
  const cos = Math.cos(leader.course_rad);
  const sin = Math.sin(leader.course_rad);
  return ({ forward_m, left_m, up_m }) => ({
    east_m: leader.east_m + forward_m * cos - left_m * sin,
    north_m: leader.north_m + forward_m * sin + left_m * cos,
    up_m: leader.up_m + up_m,
  });
}

/** The inverse of `rigid`: a place as the leader sees it. */
export function seenFrom(leader: Leader, place: Place): Offset {
  const cos = Math.cos(leader.course_rad);
  const sin = Math.sin(leader.course_rad);
  const east_m = place.east_m - leader.east_m;
  const north_m = place.north_m - leader.north_m;
  return {
    forward_m: east_m * cos + north_m * sin,
    left_m: north_m * cos - east_m * sin,
    up_m: place.up_m - leader.up_m,
  };
}

type Line = Path["line"];

/**
 * In path coordinates, as control "skein" flies: `forward` is arc length from the leader on, `left` is across the path there.
 * Before and after the line that is known, the path goes straight on.
 */
export function alongPath(leader: Leader, line: Line, avoidance_up_m: number): Placing {
  const arcs = arcsOf(line);
  const leader_arc_m = nearestArc(leader, line, arcs);
  return ({ forward_m, left_m, up_m }) => {
    const arc_m = leader_arc_m + forward_m;
    const i = segmentAt(arcs, arc_m);
    const [from_east, from_north, from_up] = line[i];
    const [to_east, to_north, to_up] = line[i + 1];
    const start_m = arcs[i];
    const length_m = arcs[i + 1] - start_m;
    const share = (arc_m - start_m) / length_m;
    const along_east = (to_east - from_east) / length_m;
    const along_north = (to_north - from_north) / length_m;
    return {
      east_m: from_east + share * (to_east - from_east) - left_m * along_north,
      north_m: from_north + share * (to_north - from_north) + left_m * along_east,
      up_m: from_up + Math.min(Math.max(share, 0), 1) * (to_up - from_up) + avoidance_up_m + up_m,
    };
  };
}

/** Horizontal arc length at each point. */
function arcsOf(line: Line): Float64Array {
  const arcs = new Float64Array(line.length);
  for (let i = 1; i < line.length; i += 1) {
    const [east_m, north_m] = line[i];
    const [before_east, before_north] = line[i - 1];
    // No length of zero: two points in one place would have no direction.
    arcs[i] = arcs[i - 1] + Math.max(Math.hypot(east_m - before_east, north_m - before_north), 1e-6);
  }
  return arcs;
}

/** The piece of the line that an arc length lies on; the first and last go on for ever. */
function segmentAt(arcs: Float64Array, arc_m: number): number {
  let low = 0;
  let high = arcs.length - 2;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (arcs[middle] <= arc_m) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** A path may cross itself or lie on itself: of pieces as near, the one in the leader's direction, and the later one, counts. */
const kWrongWay_m = 100;

function nearestArc(leader: Leader, line: Line, arcs: Float64Array): number {
  let best_m = Infinity;
  let best_arc_m = 0;
  for (let i = 0; i + 1 < line.length; i += 1) {
    const [from_east, from_north] = line[i];
    const [to_east, to_north] = line[i + 1];
    const length_m = arcs[i + 1] - arcs[i];
    const along_east = (to_east - from_east) / length_m;
    const along_north = (to_north - from_north) / length_m;
    const along_m = (leader.east_m - from_east) * along_east + (leader.north_m - from_north) * along_north;
    const reach_m = Math.min(Math.max(along_m, 0), length_m);
    const away_m = Math.hypot(
      leader.east_m - from_east - reach_m * along_east,
      leader.north_m - from_north - reach_m * along_north,
    );
    const agreement = along_east * Math.cos(leader.course_rad) + along_north * Math.sin(leader.course_rad);
    const cost_m = away_m + kWrongWay_m * (1 - agreement);
    if (cost_m <= best_m + 0.5) {
      best_m = Math.min(cost_m, best_m);
      best_arc_m = arcs[i] + reach_m;
    }
  }
  return best_arc_m;
}

/** A UAV as it flies. */
export interface Flying extends Place {
  speed_m_s: number;
  course_rad: number;
}

/** Where a new formation's leader begins: so that the slots lie best over the UAVs (cpp/controller/formation_start.cc). */
export function leaderOver(members: readonly { offset: Offset; flying: Flying }[]): Leader | null {
  if (members.length === 0) return null;
  const mean = (of: (member: (typeof members)[number]) => number) =>
    members.reduce((sum, member) => sum + of(member), 0) / members.length;
  const east = mean(({ flying }) => Math.cos(flying.course_rad));
  const north = mean(({ flying }) => Math.sin(flying.course_rad));
  const course_rad = Math.hypot(east, north) > 1e-6 ? Math.atan2(north, east) : 0;
  const middle = rigid({ east_m: 0, north_m: 0, up_m: 0, course_rad })({
    forward_m: mean(({ offset }) => offset.forward_m),
    left_m: mean(({ offset }) => offset.left_m),
    up_m: mean(({ offset }) => offset.up_m),
  });
  return {
    east_m: mean(({ flying }) => flying.east_m) - middle.east_m,
    north_m: mean(({ flying }) => flying.north_m) - middle.north_m,
    up_m: mean(({ flying }) => flying.up_m) - middle.up_m,
    course_rad,
  };
}

/** Where the leader of a formation that is flown is, carried on for `ahead_s` [s]. */
export function leaderOf(status: FormationStatus, ahead_s: number): Leader {
  const way_m = status.leader_speed_m_s * ahead_s;
  return {
    east_m: status.leader_east_m + way_m * Math.cos(status.leader_course_rad),
    north_m: status.leader_north_m + way_m * Math.sin(status.leader_course_rad),
    up_m: status.leader_up_m,
    course_rad: status.leader_course_rad,
  };
}

/** How a formation places its slots: along its path, where it flies one and its control follows it. */
export function placingOf(
  control: Control,
  leader: Leader,
  status: FormationStatus,
  path: Path | undefined,
): Placing {
  return control === "paper" || path === undefined || path.line.length < 2
    ? rigid(leader)
    : alongPath(leader, path.line, status.avoidance_up_m);
}

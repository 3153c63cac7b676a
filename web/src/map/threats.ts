/** Where two UAVs come closest, should both fly straight on. */

export interface Mover {
  east_m: number;
  north_m: number;
  speed_m_s: number;
  /** Counter-clockwise from east. */
  course_rad: number;
  climb_rad: number;
}

export interface Point {
  east_m: number;
  north_m: number;
}

export interface Approach {
  /** From now [s]. */
  time_s: number;
  /** Horizontal distance then [m]. */
  miss_m: number;
  own: Point;
  other: Point;
}

/**
 * The horizontal closest point of approach: t = -r.v / v.v for distance r and relative velocity v (Munoz et al., "TCAS II
 * resolution advisory detection", AIAA GNC 2013, t_cpa). Null when they don't close.
 */
export function closestApproach(own: Mover, other: Mover): Approach | null {
  const own_velocity = velocityOf(own);
  const other_velocity = velocityOf(other);
  const r = { east_m: other.east_m - own.east_m, north_m: other.north_m - own.north_m };
  const v = {
    east_m_s: other_velocity.east_m_s - own_velocity.east_m_s,
    north_m_s: other_velocity.north_m_s - own_velocity.north_m_s,
  };
  const closing = -(r.east_m * v.east_m_s + r.north_m * v.north_m_s);
  const speed2 = v.east_m_s ** 2 + v.north_m_s ** 2;
  if (closing <= 0 || speed2 === 0) return null;
  const time_s = closing / speed2;
  const at = (mover: Mover, velocity: typeof v): Point => ({
    east_m: mover.east_m + velocity.east_m_s * time_s,
    north_m: mover.north_m + velocity.north_m_s * time_s,
  });
  const own_at = at(own, own_velocity);
  const other_at = at(other, other_velocity);
  const miss_m = Math.hypot(other_at.east_m - own_at.east_m, other_at.north_m - own_at.north_m);
  return { time_s, miss_m, own: own_at, other: other_at };
}

function velocityOf(mover: Mover): { east_m_s: number; north_m_s: number } {
  const level_m_s = mover.speed_m_s * Math.cos(mover.climb_rad);
  return {
    east_m_s: level_m_s * Math.cos(mover.course_rad),
    north_m_s: level_m_s * Math.sin(mover.course_rad),
  };
}

/** TCAS marks climbs and descents of 500 ft/min and more with an arrow. */
const kArrow_m_s = (500 * 0.3048) / 60;

/** "↑", "↓" or "" for level flight. */
export function climbArrow(mover: Pick<Mover, "speed_m_s" | "climb_rad">): string {
  const rate_m_s = mover.speed_m_s * Math.sin(mover.climb_rad);
  return rate_m_s >= kArrow_m_s ? "↑" : rate_m_s <= -kArrow_m_s ? "↓" : "";
}

import { describe, expect, test } from "vitest";
import type { Waypoint } from "../link/messages";
import { flownLegs, straightLegs, totalsOf } from "./legs";
import {
  centreOf,
  insertWaypoint,
  midway,
  moved,
  removeWaypoint,
  reversed,
  rotated,
  type PathPlan,
} from "./path_plan";

const point = (east_m: number, north_m: number, rest: Partial<Waypoint> = {}): Waypoint => ({
  east_m,
  north_m,
  up_m: 1000,
  speed_m_s: 50,
  turn_radius_m: 0,
  ...rest,
});
const kOpen: PathPlan = { closed: false, waypoints: [point(0, 0), point(0, 3000), point(4000, 3000)] };
const kLoop: PathPlan = { ...kOpen, closed: true };
const eastNorth = (plan: PathPlan) =>
  plan.waypoints.map(({ east_m, north_m }) => [Math.round(east_m), Math.round(north_m)]);

describe("legs", () => {
  test("have length, course and time; a loop has one more, back to the first", () => {
    expect(straightLegs(kOpen).map(({ length_m }) => length_m)).toEqual([3000, 4000]);
    const loop = straightLegs(kLoop);
    expect(loop.map(({ length_m }) => length_m)).toEqual([3000, 4000, 5000]);
    expect(loop.map(({ time_s }) => time_s)).toEqual([60, 80, 100]);
    expect(loop.map(({ arrival_s }) => arrival_s)).toEqual([60, 140, 240]);
    expect(loop[0]?.course_rad).toBeCloseTo(Math.PI / 2);
    expect(loop[2]).toMatchObject({ from: 2, to: 0 });
    expect(totalsOf(loop)).toEqual({ length_m: 12_000, time_s: 240 });
  });

  test("two waypoints make no loop", () => {
    expect(straightLegs({ closed: true, waypoints: kOpen.waypoints.slice(0, 2) })).toHaveLength(1);
  });

  test("a speed that changes counts with its mean", () => {
    const legs = straightLegs({ closed: false, waypoints: [point(0, 0), point(6000, 0, { speed_m_s: 70 })] });
    expect(legs[0]?.time_s).toBe(100);
  });

  test("as flown they begin at the leader", () => {
    const legs = [
      { from: null, to: 0, length_m: 900, time_s: 18, course_rad: 0 },
      { from: 0, to: 1, length_m: 2800, time_s: 56, course_rad: 1 },
    ];
    expect(flownLegs({ ok: true, reason: "", line: [], problems: [], legs }).at(-1)?.arrival_s).toBe(74);
  });
});

describe("edits", () => {
  test("insert and remove; a loop that gets too short is none", () => {
    const more = insertWaypoint(kLoop, 1, point(9, 9));
    expect(eastNorth(more)).toEqual([
      [0, 0],
      [9, 9],
      [0, 3000],
      [4000, 3000],
    ]);
    expect(removeWaypoint(more, 1)).toEqual(kLoop);
    expect(removeWaypoint(kLoop, 0).closed).toBe(false);
  });

  test("a loop is reversed from the same first waypoint, an open path from its end", () => {
    expect(eastNorth(reversed(kLoop))).toEqual([
      [0, 0],
      [4000, 3000],
      [0, 3000],
    ]);
    expect(eastNorth(reversed(kOpen))[0]).toEqual([4000, 3000]);
  });

  test("turns clockwise about the centre, which stays", () => {
    const turned = rotated(kOpen, Math.PI / 2);
    expect(centreOf(turned).east_m).toBeCloseTo(centreOf(kOpen).east_m);
    // The first leg went north; now it goes east.
    expect(straightLegs(turned)[0]?.course_rad).toBeCloseTo(0);
  });

  test("moves all alike", () => {
    expect(eastNorth(moved(kOpen, 100, -50))[2]).toEqual([4100, 2950]);
    expect(moved(kOpen, 0, 0, 30).waypoints[1]?.up_m).toBe(1030);
  });

  test("midway has mean altitude and speed", () => {
    const between = midway(point(0, 0, { up_m: 900 }), point(10, 0, { speed_m_s: 60, turn_radius_m: 500 }));
    expect(between).toEqual({ east_m: 5, north_m: 0, up_m: 950, speed_m_s: 55, turn_radius_m: 0 });
  });
});

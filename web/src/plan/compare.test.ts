import { expect, test } from "vitest";
import type { Waypoint } from "../link/messages";
import { differences, samePath } from "./compare";
import { changeWaypoint, insertWaypoint, kStraightOn, removeWaypoint, type PathPlan } from "./path_plan";

const point = (east_m: number, north_m: number): Waypoint => ({
  east_m,
  north_m,
  up_m: 1000,
  speed_m_s: 50,
  turn_radius_m: 0,
});
const kPath: PathPlan = {
  closed: false,
  waypoints: [point(0, 0), point(0, 5000), point(5000, 5000), point(9000, 5000)],
};

test("millimetres are no difference, centimetres are", () => {
  expect(samePath(kPath, changeWaypoint(kPath, 1, { east_m: 0.004 }))).toBe(true);
  expect(differences(kPath, changeWaypoint(kPath, 1, { east_m: 0.004 }))).toEqual([]);
  expect(samePath(kPath, changeWaypoint(kPath, 1, { east_m: 0.02 }))).toBe(false);
  expect(samePath(kPath, changeWaypoint(kPath, 1, { speed_m_s: 50.1 }))).toBe(false);
  expect(samePath(kPath, { ...kPath, closed: true })).toBe(false);
});

test("each change of a waypoint is told", () => {
  const changed = changeWaypoint(kPath, 2, {
    north_m: 5300,
    up_m: 1200,
    speed_m_s: 55.5,
    turn_radius_m: 2000,
  });
  expect(differences(kPath, changed)).toEqual([
    "Waypoint 3: moves 300 m; altitude 1000 → 1200 m ENU; speed 50.0 → 55.5 m/s; turn radius the smallest in comfort → 2000 m.",
  ]);
});

test("what has come and gone is told by its numbers", () => {
  expect(differences(kPath, insertWaypoint(kPath, 2, point(1, 1)))).toEqual(["Waypoint 3 is new."]);
  expect(differences(kPath, removeWaypoint(kPath, 1))).toEqual(["Waypoint 2 of the old path is dropped."]);
  const replaced = insertWaypoint(changeWaypoint(kPath, 1, { north_m: 1 }), 2, point(7, 7));
  expect(differences(kPath, replaced)).toEqual([
    "Waypoint 2 of the old path gives way to waypoints 2 and 3 of the new one.",
  ]);
});

test("loop, straight on and a first path are told", () => {
  expect(differences(kPath, { ...kPath, closed: true })).toEqual(["The path becomes a loop."]);
  expect(differences(kPath, kStraightOn)).toEqual(["Straight on: all 4 waypoints are dropped."]);
  expect(differences(kStraightOn, kPath)).toEqual(["A new path of 4 waypoints."]);
});

import { expect, test } from "vitest";
import { climbArrow, closestApproach, type Mover } from "./threats";

const kNorth = Math.PI / 2;
const mover = (east_m: number, north_m: number, course_rad: number, speed_m_s = 50): Mover => ({
  east_m,
  north_m,
  course_rad,
  speed_m_s,
  climb_rad: 0,
});

test("head-on they meet half way", () => {
  const approach = closestApproach(mover(0, 0, kNorth), mover(0, 2000, -kNorth));
  expect(approach?.time_s).toBeCloseTo(20, 9);
  expect(approach?.miss_m).toBeCloseTo(0, 6);
  expect(approach?.own.north_m).toBeCloseTo(1000, 6);
  expect(approach?.other.north_m).toBeCloseTo(1000, 6);
});

test("crossing at a right angle, each has a point of its own and they miss by what lies between", () => {
  // One flies north; the other comes from the east 400 m further north, as far away: it is ahead by 400 m on the way.
  const approach = closestApproach(mover(0, 0, kNorth), mover(1000, 1400, Math.PI));
  expect(approach?.time_s).toBeCloseTo(24, 9);
  expect(approach?.own.east_m).toBeCloseTo(0, 6);
  expect(approach?.own.north_m).toBeCloseTo(1200, 6);
  expect(approach?.other.east_m).toBeCloseTo(-200, 6);
  expect(approach?.other.north_m).toBeCloseTo(1400, 6);
  expect(approach?.miss_m).toBeCloseTo(Math.hypot(200, 200), 6);
});

test("it is the least distance of all times", () => {
  const a = mover(0, 0, 0.3, 40);
  const b = mover(900, 500, 3.5, 60);
  const approach = closestApproach(a, b);
  const distance_m = (t: number) =>
    Math.hypot(
      b.east_m - a.east_m + t * (60 * Math.cos(3.5) - 40 * Math.cos(0.3)),
      b.north_m - a.north_m + t * (60 * Math.sin(3.5) - 40 * Math.sin(0.3)),
    );
  expect(approach).not.toBeNull();
  const time_s = approach?.time_s ?? NaN;
  expect(approach?.miss_m).toBeCloseTo(distance_m(time_s), 6);
  for (const t of [0, time_s - 1, time_s + 1, 100])
    expect(distance_m(t)).toBeGreaterThan(approach?.miss_m ?? NaN);
});

test("those that part, or fly side by side, don't come closer", () => {
  expect(closestApproach(mover(0, 0, -kNorth), mover(0, 2000, kNorth))).toBeNull();
  expect(closestApproach(mover(0, 0, kNorth), mover(100, 0, kNorth))).toBeNull();
});

test("a climb of 500 ft/min has an arrow, a lesser one none", () => {
  const at = (rate_m_s: number) => climbArrow({ speed_m_s: 50, climb_rad: Math.asin(rate_m_s / 50) });
  expect([2.5, 2.6, -2.5, -2.6, 0].map(at)).toEqual(["", "↑", "", "↓", ""]);
});

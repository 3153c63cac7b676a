import { expect, test } from "vitest";
import { flownLegs, straightLegs } from "./legs";
import { profileOf } from "./profile";

const point = (east_m: number, north_m: number, up_m: number) => ({
  east_m,
  north_m,
  up_m,
  speed_m_s: 50,
  turn_radius_m: 0,
});
const kPlan = { closed: false, waypoints: [point(0, 0, 100), point(0, 300, 200), point(400, 300, 150)] };
const kLoop = { ...kPlan, closed: true };

test("along straight legs each waypoint lies where its distance says", () => {
  const { line, waypoints } = profileOf(kPlan, straightLegs(kPlan), []);
  expect(waypoints).toEqual([
    { along_m: 0, up_m: 100 },
    { along_m: 300, up_m: 200 },
    { along_m: 700, up_m: 150 },
  ]);
  expect(line).toEqual(waypoints);
});

test("a loop comes back", () => {
  expect(profileOf(kLoop, straightLegs(kLoop), []).line.at(-1)).toEqual({ along_m: 1200, up_m: 100 });
});

test("as flown it begins at the leader, and waypoints lie where the legs say", () => {
  const leg = { time_s: 1, course_rad: 0 };
  const legs = flownLegs({
    ok: true,
    reason: "",
    line: [],
    problems: [],
    legs: [
      { from: null, to: 0, length_m: 500, ...leg },
      { from: 0, to: 1, length_m: 280, ...leg },
      { from: 1, to: 2, length_m: 390, ...leg },
    ],
  });
  const flown = [-3500, -1500, -500, 0, 300].map((north_m, i) => [0, north_m, 90 + i] as const);
  const { line, waypoints } = profileOf(kPlan, legs, flown);
  expect(line).toEqual([
    { along_m: 0, up_m: 92 },
    { along_m: 500, up_m: 93 },
    { along_m: 800, up_m: 94 },
  ]);
  expect(waypoints.map(({ along_m }) => along_m)).toEqual([500, 780, 1170]);
});

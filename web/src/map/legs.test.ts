import { expect, test } from "vitest";
import { legBetween } from "./legs";

const kDegree = Math.PI / 180;
const at = (latitude_deg: number, longitude_deg: number) => ({ latitude_deg, longitude_deg });

// Parts of a degree along a meridian, a parallel and the equator of WGS-84; Berlin to Paris.
test.each([
  [at(40.08, 116.58), at(40.09, 116.58), 0, 1110.36],
  [at(40.08, 116.58), at(40.08, 116.6), 90, 1705.9],
  [at(0, 179.99), at(0, -179.99), 90, 2226.39],
  [at(52.5, 13.4), at(48.85, 2.35), 246.7, 878_000],
])("%o to %o", (from, to, bearing_deg, length_m) => {
  const leg = legBetween(from, to);
  expect(Math.abs(leg.length_m / length_m - 1)).toBeLessThan(0.003);
  expect(Math.abs(leg.bearing_rad / kDegree - bearing_deg)).toBeLessThan(0.3);
});

test("a bearing is 0 to 360 degrees", () => {
  expect(legBetween(at(10, 10), at(10, 9)).bearing_rad / kDegree).toBeCloseTo(270, 0);
  expect(legBetween(at(10, 10), at(9, 10)).bearing_rad / kDegree).toBeCloseTo(180, 6);
});

test("from a place to itself it is no way", () => {
  expect(legBetween(at(10, 10), at(10, 10)).length_m).toBeLessThan(1e-6);
});

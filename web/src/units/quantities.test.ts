import { afterEach, expect, test } from "vitest";
import { altitude_unit, distance_unit, speed_unit } from "../state/settings";
import {
  altitude,
  altitudeAbove,
  distance,
  errorText,
  lengthInSteps,
  roundLength_m,
  speed,
} from "./quantities";

afterEach(() => {
  altitude_unit.value = "m";
  distance_unit.value = "m";
  speed_unit.value = "m/s";
});

test("each quantity follows its own unit", () => {
  altitude_unit.value = "ft";
  speed_unit.value = "kt";
  expect(altitude.full(304.8)).toBe("1000 ft");
  expect(altitudeAbove(304.8)).toBe("1000 ft ENU");
  expect(distance.full(304.8)).toBe("305 m");
  expect(speed.full(51.4444, 1)).toBe("100.0 kt");
  speed_unit.value = "km/h";
  expect(speed.text(10)).toBe("36");
});

test("what is typed comes back as SI", () => {
  distance_unit.value = "ft";
  expect(distance.toSi(distance.value(123.4))).toBeCloseTo(123.4, 9);
  expect(distance.toSi(1)).toBeCloseTo(0.3048, 9);
});

test("scales and grids have round lengths: kilometres from 1000 m on", () => {
  expect(roundLength_m(700)).toBeCloseTo(1000, 6);
  expect(lengthInSteps(500, 500)).toBe("500 m");
  expect(lengthInSteps(1500, 500)).toBe("1.5 km");
});

test("scales and grids are round in feet, and in nautical miles when they are long", () => {
  distance_unit.value = "ft";
  const near_m = roundLength_m(500);
  expect(lengthInSteps(near_m, near_m)).toBe("2000 ft");
  expect(lengthInSteps(4 * near_m, near_m), "a grid keeps its unit").toBe("8000 ft");
  const far_m = roundLength_m(1600);
  expect(lengthInSteps(far_m, far_m)).toBe("1 NM");
  expect(lengthInSteps(far_m / 2, far_m), "half a scale").toBe("0.5 NM");
});

test("a large error from a slot goes without tenths", () => {
  expect([-999.4, 1000.6].map((m) => errorText(distance, m))).toEqual(["−999.4", "1001"]);
});

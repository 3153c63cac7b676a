import { afterEach, expect, test } from "vitest";
import { altitude_unit, distance_unit, speed_unit } from "../state/settings";
import { altitude, altitudeAbove, distance, speed } from "./quantities";

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

import { expect, test } from "vitest";
import { wrapped } from "../units/geodesy";
import { enuText, latLonText, mgrsText } from "./coordinates";

const at = (latitude_deg: number, longitude_deg: number) => ({ latitude_deg, longitude_deg });

test("latitude and longitude name their hemisphere, and stay on the globe", () => {
  expect(latLonText(at(40.08, 116.58))).toBe("40.08000° N, 116.58000° E");
  expect(latLonText(at(-33.123456, -70.5))).toBe("33.12346° S, 70.50000° W");
  expect(latLonText(at(0, 181))).toBe("0.00000° N, 179.00000° W");
  expect([0, 180, -180, 540, -541].map(wrapped)).toEqual([0, -180, -180, -180, 179]);
});

test("local coordinates have a true minus sign, and a dash without a frame", () => {
  expect(enuText({ east_m: 12.4, north_m: -300.6 })).toBe("E 12 m, N −301 m");
  expect(enuText(null)).toBe("—");
});

test("MGRS is that of known places, in groups", () => {
  // The Washington Monument and the Eiffel Tower, as published.
  expect(mgrsText(at(38.8895, -77.0353))).toMatch(/^18S UJ 234\d\d 064\d\d$/);
  expect(mgrsText(at(48.8582, 2.2945))).toMatch(/^31U DQ 482\d\d 119\d\d$/);
});

test("where MGRS ends there is a dash", () => {
  expect(mgrsText(at(85, 10))).toBe("—");
  expect(mgrsText(at(-80.5, 10))).toBe("—");
});

import { expect, test } from "vitest";
import { detailOf, headingOf, headingStep, keyOf, kHeadings } from "./looks";

test("a heading is off by half a step at most, all around", () => {
  for (let degrees = -720; degrees <= 720; degrees += 7) {
    const heading = (degrees * Math.PI) / 180;
    const step = headingStep(heading);
    expect(step).toBeGreaterThanOrEqual(0);
    expect(step).toBeLessThan(kHeadings);
    const off = Math.abs(
      Math.atan2(Math.sin(headingOf(step) - heading), Math.cos(headingOf(step) - heading)),
    );
    expect(off).toBeLessThanOrEqual(Math.PI / kHeadings + 1e-9);
  }
});

test("no two looks have the same key", () => {
  const keys = new Set<number>();
  let looks = 0;
  for (let kind = 0; kind <= 10; kind += 1) {
    for (const detail of ["full", "small", "dots"] as const) {
      for (let identity = 0; identity <= 6; identity += 1) {
        for (let step = 0; step < kHeadings; step += 1) {
          keys.add(keyOf(kind, detail, identity, step));
          looks += 1;
        }
      }
    }
  }
  expect(keys.size).toBe(looks);
});

test("a hundred are drawn in full, a thousand smaller, five thousand as dots", () => {
  expect([100, 1000, 5000].map((count) => detailOf(count, 1280, 720))).toEqual(["full", "small", "dots"]);
  expect(detailOf(1000, 3840, 2160)).toBe("full");
});

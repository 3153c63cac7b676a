import { expect, test } from "vitest";
import { spanWith, ticks, timeOf, xOf } from "./scale";

const kScale = { from_s: 100, to_s: 300, width_px: 1000 };

test("a time has its place, and a place its time", () => {
  expect(xOf(kScale, 150)).toBe(250);
  expect(timeOf(kScale, 250)).toBe(150);
  expect(timeOf(kScale, -40)).toBe(100);
  expect(timeOf(kScale, 4000)).toBe(300);
});

test("ticks are round, within the scale, and leave room for their labels", () => {
  for (const length_s of [3, 47, 600, 3599, 7200, 100_000, 5_000_000]) {
    for (const width_px of [300, 1250, 3800]) {
      const scale = { from_s: 7.3, to_s: 7.3 + length_s, width_px };
      const at = ticks(scale).map((t_s) => xOf(scale, t_s));
      expect(at.length).toBeLessThanOrEqual(width_px / 84 + 1);
      at.forEach((x_px, i) => {
        expect(x_px).toBeGreaterThanOrEqual(0);
        expect(x_px).toBeLessThanOrEqual(width_px);
        if (i > 0) expect(x_px - (at[i - 1] ?? 0)).toBeGreaterThanOrEqual(83.9);
      });
    }
  }
  expect(ticks(kScale)).toEqual([120, 150, 180, 210, 240, 270, 300].filter((t_s) => t_s % 30 === 0));
});

test("what is played stays in sight when the line is zoomed", () => {
  const span = { from_s: 100, to_s: 200 };
  expect(spanWith(span, 150, 1000)).toBe(span);
  expect(spanWith(span, 201, 1000)).toEqual({ from_s: 191, to_s: 291 });
  expect(spanWith(span, 5, 1000)).toEqual({ from_s: 0, to_s: 100 });
  expect(spanWith(span, 990, 1000)).toEqual({ from_s: 900, to_s: 1000 });
});

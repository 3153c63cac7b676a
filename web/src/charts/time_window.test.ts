import { expect, test } from "vitest";
import { kAll, pan, spanOf, zoom } from "./time_window";

test("a window that follows moves on with the flight, and never begins before it", () => {
  expect(spanOf({ last_s: 60 }, 0, 600)).toEqual({ from_s: 540, to_s: 600 });
  expect(spanOf({ last_s: 60 }, 0, 30)).toEqual({ from_s: 0, to_s: 30 });
  expect(spanOf(kAll, 5, 600)).toEqual({ from_s: 5, to_s: 600 });
  expect(spanOf({ from_s: 10, to_s: 20 }, 0, 600)).toEqual({ from_s: 10, to_s: 20 });
});

test("zooming keeps the time under the pointer in its place", () => {
  expect(zoom({ from_s: 0, to_s: 600 }, 0.5, 200, 0, 600)).toEqual({ from_s: 100, to_s: 400 });
  expect(zoom({ from_s: 0, to_s: 600 }, 0.5, 600, 0, 600)).toEqual({ last_s: 300 });
  expect(zoom({ from_s: 100, to_s: 400 }, 100, 200, 0, 600)).toEqual(kAll);
  const closest = spanOf(zoom({ from_s: 100, to_s: 104 }, 1e-6, 102, 0, 600), 0, 600);
  expect(closest.to_s - closest.from_s).toBeCloseTo(2);
});

test("panning stays within the flight, and at its end follows it", () => {
  expect(pan({ from_s: 100, to_s: 200 }, 0.1, 0, 600)).toEqual({ from_s: 110, to_s: 210 });
  expect(pan({ from_s: 5, to_s: 105 }, -1, 0, 600)).toEqual({ from_s: 0, to_s: 100 });
  expect(pan({ from_s: 450, to_s: 550 }, 1, 0, 600)).toEqual({ last_s: 100 });
});

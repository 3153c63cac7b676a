import { expect, test } from "vitest";
import { fromCut, quietCut } from "./round_scale";

test("courses about north stay together, cut in the south", () => {
  const courses = [355, 2, 358, 5, NaN];
  const cut = quietCut(courses, 360);
  expect(cut).toBe(-180);
  expect(courses.slice(0, 4).map((course) => fromCut(course, cut, 360))).toEqual([-5, 2, -2, 5]);
});

test("courses about south are cut in the north", () => {
  const cut = quietCut([170, 190], 360);
  expect([170, 190].map((course) => fromCut(course, cut, 360) - cut)).toEqual([170, 190]);
});

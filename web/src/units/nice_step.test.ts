import { expect, test } from "vitest";
import { niceStep } from "./nice_step";

test.each([
  [1, 1],
  [1.1, 2],
  [3, 5],
  [500, 500],
  [501, 1000],
  [0.03, 0.05],
])("the round step for %f is %f", (value, expected) => expect(niceStep(value)).toBeCloseTo(expected, 9));

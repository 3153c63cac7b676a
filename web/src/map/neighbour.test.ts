import { expect, test } from "vitest";
import { neighbourOf } from "./neighbour";

test("goes around, and begins at either end", () => {
  const ids = [3, 5, 8];
  expect(neighbourOf(ids, null, 1)).toBe(3);
  expect(neighbourOf(ids, null, -1)).toBe(8);
  expect(neighbourOf(ids, 5, 1)).toBe(8);
  expect(neighbourOf(ids, 8, 1)).toBe(3);
  expect(neighbourOf(ids, 3, -1)).toBe(8);
  expect(neighbourOf(ids, 99, 1)).toBe(3);
  expect(neighbourOf([], null, 1)).toBeNull();
});

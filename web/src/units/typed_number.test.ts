import { expect, test } from "vitest";
import { numberProblem, parseNumber } from "./typed_number";

test.each([
  ["12.5", 12.5],
  ["12,5", 12.5],
  [" \u22123 ", -3],
  ["1 000", 1000],
  [".5", 0.5],
  ["", null],
  ["1e5", null],
  ["12m", null],
  ["-", null],
])("“%s” is %s", (text, value) => {
  expect(parseNumber(text)).toBe(value);
});

test("a word, or nothing, may stand for zero", () => {
  expect(parseNumber("Auto", "auto")).toBe(0);
  expect(parseNumber("", "auto")).toBe(0);
});

test("says what would be right", () => {
  const limits = { least: 1, most: 400, unit: "m/s" };
  expect(numberProblem("50", limits)).toBeNull();
  expect(numberProblem("500", limits)).toBe("Must be 1 to 400 m/s.");
  expect(numberProblem("fast", { ...limits, zero: "auto" })).toBe("Not a number: 1 to 400 m/s, or “auto”.");
});

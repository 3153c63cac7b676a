import { describe, expect, test } from "vitest";
import { clock, compass, duration, fixed, fixedOrNone, utc } from "./format";

describe("fixed", () => {
  test("has a true minus sign", () => expect(fixed(-12.34, 1)).toBe("\u221212.3"));
  test("never says minus zero", () => expect(fixed(-0.04, 1)).toBe("0.0"));
  test("is an em dash for none", () => expect(fixedOrNone(-1)).toBe("—"));
  test("keeps a real zero", () => expect(fixedOrNone(0)).toBe("0"));
});

describe("compass", () => {
  test.each([
    [0, "090"],
    [Math.PI / 2, "000"],
    [Math.PI, "270"],
    [-Math.PI / 2, "180"],
    [-Math.PI, "270"],
    [Math.PI / 2 + 0.001, "000"], // 359.94 degrees is north, not 360
    [5 * Math.PI, "270"], // unwrapped
  ])("course %f is %s", (course_rad, expected) => expect(compass(course_rad)).toBe(expected));
});

describe("times", () => {
  test("clock", () => {
    expect(clock(0)).toBe("0:00:00");
    expect(clock(3725.9)).toBe("1:02:05");
    expect(clock(-5)).toBe("\u22120:00:05");
  });
  test("utc", () => expect(utc(1577836800000000)).toBe("00:00:00"));
  test("duration", () => {
    expect(duration(7.9)).toBe("7 s");
    expect(duration(200)).toBe("3 min 20 s");
    expect(duration(7500)).toBe("2 h 5 min");
    expect(duration(-1)).toBe("0 s");
  });
});

import { expect, test } from "vitest";
import { clockTenths, spoken, tickLabel, utcDay } from "./time_text";
import { parseTime } from "./typed_time";

test("clocks show tenths, rounded down", () => {
  expect(clockTenths(0)).toBe("0:00:00.0");
  expect(clockTenths(0.3)).toBe("0:00:00.3");
  expect(clockTenths(59.96)).toBe("0:00:59.9");
  expect(clockTenths(3725.94)).toBe("1:02:05.9");
});

test("labels have hours only where there are some", () => {
  expect(tickLabel(90, 600)).toBe("01:30");
  expect(tickLabel(90, 7200)).toBe("0:01:30");
});

test("the day is told in UTC, and times are spoken in words", () => {
  expect(utcDay(1577836800000000)).toBe("2020-01-01");
  expect(spoken(0.4)).toBe("0 seconds");
  expect(spoken(3661)).toBe("1 hour 1 minute 1 second");
  expect(spoken(120)).toBe("2 minutes");
});

// Begins at 14:29:30.5 UTC.
const kRecorded = { at_s: 60, duration_s: 600, start_utime: Date.UTC(2026, 10, 25, 14, 29, 30, 500) * 1000 };

test.each([
  ["90", 90],
  ["1:30", 90],
  ["1:30.5", 90.5],
  ["0:01:30", 90],
  ["T+ 1:30", 90],
  ["+15", 75],
  ["-0:20", 40],
  ["\u221220", 40],
  ["-500", 0], // as far as there is
  ["+5000", 600],
  ["14:30Z", 29.5],
  ["14:30:05 UTC", 34.5],
  ["14:29:30z", 0], // its very first second
])("%s is a time", (text, t_s) => {
  expect(parseTime(text, kRecorded)).toEqual({ t_s });
});

test.each(["", "soon", "1:75", "1:2:3:4", "14Z", "12:99 UTC", "-", "1e9"])(
  "%j is none, and says how",
  (text) => {
    expect(parseTime(text, kRecorded)).toEqual({ problem: expect.stringContaining("1:30") as string });
  },
);

test("what is after the end is told", () => {
  expect(parseTime("20:00", kRecorded)).toEqual({ problem: "The recording ends before that." });
  expect(parseTime("14:00Z", kRecorded)).toEqual({ problem: "The recording ends before that." });
});

import { expect, test } from "vitest";
import type { ListedRecording } from "../link/recording_messages";
import { alarmsText, fileOf, found, pageOf, whatText, whenText } from "./words";

const kRecording: ListedRecording = {
  name: "Paper triangle-20261125-143000.lcm",
  scenario: "Paper triangle",
  start_utime: Date.UTC(2026, 10, 25, 14, 30) * 1000,
  duration_s: 725,
  bytes: 1_440_000,
  parts: 1,
  vehicles: 3,
  alarms: 4,
  warnings: 1,
  markers: 0,
  indexed: true,
  progress: 1,
  recording_now: false,
  problem: "",
};

test("a recording is told in a line or two", () => {
  expect(whenText(kRecording)).toBe("2026-11-25 14:30:00 UTC, 12 min 5 s");
  expect(whatText(kRecording)).toBe("3 UAVs, 1.4 MB");
  expect(whatText({ ...kRecording, parts: 2, markers: 1, vehicles: 1 })).toBe(
    "1 UAV, 1.4 MB in 2 parts, 1 marker",
  );
  expect(alarmsText(kRecording)).toBe("4 alarms, 1 warning");
  expect(alarmsText({ ...kRecording, alarms: 0, warnings: 0 })).toBe("No alarm");
});

test("what is not known yet is not told", () => {
  const unread = {
    ...kRecording,
    start_utime: null,
    duration_s: null,
    vehicles: null,
    alarms: null,
    markers: null,
  };
  expect([whenText(unread), whatText(unread), alarmsText(unread)]).toEqual(["", "1.4 MB", ""]);
});

test("recordings are found by scenario, name or day", () => {
  const other = { ...kRecording, name: "alps.lcm", scenario: "Alps", start_utime: 0 };
  const names = (text: string) => found([kRecording, other], text).map(({ name }) => name);
  expect(names("")).toHaveLength(2);
  expect(names("TRIANGLE 2026-11")).toEqual([kRecording.name]);
  expect(names("alps")).toEqual(["alps.lcm"]);
  expect(names("alps 2026")).toEqual([]);
});

test("names are encoded in addresses", () => {
  expect(pageOf("a b&c.lcm")).toBe("?recording=a%20b%26c.lcm");
  expect(fileOf("a b.lcm", 0)).toBe("api/recordings/a%20b.lcm/file");
  expect(fileOf("a.lcm", 2)).toBe("api/recordings/a.lcm/file?part=2");
});

import { expect, test } from "vitest";
import type { Mark } from "../link/recording_messages";
import { damageText, groupMarks, landmarkFrom, marksAt } from "./marks";

const mark = (t_s: number, kind: Mark["kind"], severity = 0): Mark => ({
  t_s,
  kind,
  severity,
  code: "c",
  text: `${kind} at ${t_s}`,
});
const kMarks = [
  mark(1, "event"),
  mark(10, "alarm", 3),
  mark(10.2, "event", 2),
  mark(20, "marker"),
  mark(30, "alarm", 1),
];

test("jumps lead to alarms and markers, not to every event", () => {
  expect(landmarkFrom(kMarks, 0, 1, false)?.t_s).toBe(10);
  expect(landmarkFrom(kMarks, 10, 1, false)?.t_s).toBe(20);
  expect(landmarkFrom(kMarks, 20, -1, false)?.t_s).toBe(10);
  expect(landmarkFrom(kMarks, 30, 1, false)).toBeNull();
  expect(landmarkFrom(kMarks, 10, -1, false)).toBeNull();
});

test("while it plays, back leads beyond the one that was just passed", () => {
  expect(landmarkFrom(kMarks, 20.6, -1, true)?.t_s).toBe(10);
  expect(landmarkFrom(kMarks, 20.6, -1, false)?.t_s).toBe(20);
});

test("marks that would cover one another are one, drawn as the weightiest", () => {
  const groups = groupMarks(kMarks, (t_s) => t_s * 2, 5);
  expect(groups.map(({ marks }) => marks.length)).toEqual([1, 2, 1, 1]);
  expect(groups[1]?.shown).toBe(kMarks[1]);
  const all = groupMarks(kMarks, () => 0, 5);
  expect(all).toHaveLength(1);
  expect(all[0]?.shown.kind).toBe("marker");
});

test("the pointer is told what is near, the weightiest first, and how many more", () => {
  const { told, more } = marksAt(kMarks, 12, 9, 2);
  expect(told.map(({ t_s }) => t_s)).toEqual([20, 10]);
  expect(more).toBe(1);
});

test("damage is said in words", () => {
  expect(damageText([])).toBe("");
  expect(damageText([{ t_s: 1, bytes: 9, reason: "torn" }])).toContain("A part of this recording");
  expect(damageText(Array.from({ length: 3 }, () => ({ t_s: 1, bytes: 9, reason: "" })))).toContain(
    "3 parts",
  );
});

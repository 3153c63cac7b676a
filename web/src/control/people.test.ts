import { expect, test } from "vitest";
import {
  isFreeForYou,
  nameProblem,
  newsOf,
  othersOf,
  whyNot,
  type ControlMessage,
  type Person,
} from "./people";

const person = (id: number, name: string, more: Partial<Person> = {}): Person => ({
  id,
  name,
  may_operate: true,
  kept_for_s: null,
  waits_for_s: null,
  ...more,
});

const seen = (you: number, holder: number, people: Person[]): ControlMessage => ({
  type: "control",
  you,
  token: "t",
  may_operate: true,
  holder,
  people,
});

const both = [person(1, "Ada"), person(2, "Bob")];

test("who does not hold control is told who does", () => {
  expect(whyNot(seen(1, 1, both))).toBe("");
  expect(whyNot(seen(2, 1, both))).toBe("Ada holds control");
  expect(whyNot(seen(2, 0, both))).toMatch(/^Nobody holds control/);
});

test("as long as nothing is known, the bridge decides", () => {
  expect(whyNot(null)).toBe("");
  expect(whyNot(seen(0, 1, both))).toBe("");
});

test("control is free for who may operate, while nobody holds it", () => {
  expect(isFreeForYou(seen(2, 0, both))).toBe(true);
  expect(isFreeForYou(seen(2, 1, both))).toBe(false);
  expect(isFreeForYou({ ...seen(2, 0, both), may_operate: false })).toBe(false);
  expect(isFreeForYou(null)).toBe(false);
});

test("who asks comes first", () => {
  const people = [...both, person(3, "Cleo", { waits_for_s: 9 })];
  expect(othersOf(seen(1, 1, people)).map(({ name }) => name)).toEqual(["Cleo", "Bob"]);
});

test("losing, getting and being refused control is news, and nothing else is", () => {
  expect(newsOf(seen(1, 1, both), seen(1, 2, both))).toBe("Bob has control now. You are looking on.");
  expect(newsOf(seen(2, 1, both), seen(2, 2, both))).toBe("You have control now.");
  const asking = [person(1, "Ada"), person(2, "Bob", { waits_for_s: 9 })];
  expect(newsOf(seen(2, 1, asking), seen(2, 1, both))).toBe("Ada keeps control.");
  // Taken while it was free: the person did that.
  expect(newsOf(seen(2, 0, both), seen(2, 2, both))).toBeNull();
  expect(newsOf(null, seen(2, 1, both))).toBeNull();
  expect(newsOf(seen(1, 1, both), seen(1, 0, both))).toBeNull();
  expect(newsOf(seen(3, 1, both), seen(3, 2, both))).toBeNull();
});

test("who comes back after control has gone to somebody else is told", () => {
  const later = [person(2, "Bob"), person(3, "Ada")];
  expect(newsOf(seen(1, 1, both), seen(3, 2, later))).toBe("Bob has control now. You are looking on.");
  expect(newsOf(seen(1, 1, both), seen(0, 2, later))).toBeNull();
  expect(newsOf(seen(1, 1, both), seen(3, 3, later))).toBeNull();
});

test("a name is one that fits and can be read", () => {
  expect(nameProblem("Ada")).toBe("");
  expect(nameProblem("ü".repeat(40))).toBe("");
  expect(nameProblem("ü".repeat(41))).toMatch(/40 characters/);
  expect(nameProblem("   ")).toMatch(/name/);
  expect(nameProblem("a\u0007b")).toMatch(/control characters/);
});

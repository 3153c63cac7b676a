import { expect, test } from "vitest";
import type { Roster } from "../link/messages";
import { Fleet } from "../state/fleet";
import { statusFrame } from "../state/frames_for_tests";
import { RowList, type ListWish } from "./row_list";
import { kWorstFirst } from "./row_order";

const kRoster = {
  vehicles: [1, 2, 3].map((id) => ({ id, callsign: `UAV${id}`, model: "default", has_payload: true })),
} as Roster;
const kWish: ListWish = { roster: kRoster, order: kWorstFirst, show: "all", text: "" };

function listWith(level: number[]) {
  const fleet = new Fleet();
  const list = new RowList();
  const set = (levels: number[]) => {
    fleet.take(statusFrame([1, 2, 3], { level: Uint8Array.from(levels) }), 0);
  };
  set(level);
  const at = (now_ms: number, held = false, wish = kWish) => {
    list.update(fleet, wish, new Map(), new Map(), now_ms, held);
    return list.ids;
  };
  return { list, set, at };
}

test("the order changes every two seconds at most", () => {
  const { set, at } = listWith([0, 0, 0]);
  expect(at(10_000)).toEqual([1, 2, 3]);
  set([0, 0, 3]);
  expect(at(11_900)).toEqual([1, 2, 3]);
  expect(at(12_100)).toEqual([3, 1, 2]);
});

test("it stands still while somebody is at it, says so, and follows afterwards", () => {
  const { list, set, at } = listWith([0, 0, 0]);
  at(10_000);
  set([0, 3, 0]);
  expect(at(20_000, true)).toEqual([1, 2, 3]);
  expect(list.outdated).toBe(true);
  expect(at(22_000)).toEqual([2, 1, 3]);
  expect(list.outdated).toBe(false);
});

test("a new filter or fleet counts at once, also while it is held", () => {
  const { at } = listWith([0, 3, 0]);
  at(10_000);
  expect(at(10_100, true, { ...kWish, show: "alerting" })).toEqual([2]);
  const two = { vehicles: kRoster.vehicles.slice(0, 2) } as Roster;
  expect(at(10_200, true, { ...kWish, roster: two })).toEqual([2, 1]);
});

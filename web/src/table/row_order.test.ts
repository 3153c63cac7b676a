import { expect, test } from "vitest";
import { kHasSlot } from "../link/frames";
import type { Formation } from "../link/messages";
import { Fleet, kLinkLost } from "../state/fleet";
import { motionFrame, statusFrame } from "../state/frames_for_tests";
import { filterVehicles, inForce, kWorstFirst, orderIds, type SortKey } from "./row_order";

const kIds = [1, 2, 3, 4, 5];
const kVehicles = kIds.map((id) => ({ id, callsign: `UAV${id}`, model: "default", has_payload: id < 4 }));
const f32 = (...values: number[]) => Float32Array.from(values);
const u8 = (...values: number[]) => Uint8Array.from(values);

function fleet(): Fleet {
  const result = new Fleet();
  result.take(motionFrame(kIds, { up_m: f32(1000, 1200, 900, 1000, 1100) }), 0);
  result.take(
    statusFrame(kIds, {
      formation_id: Int32Array.of(1, 1, 2, 2, 0),
      level: u8(0, 0, 3, 0, 1),
      downlink: u8(0, 0, 0, kLinkLost, 0),
      flags: u8(kHasSlot, kHasSlot, kHasSlot, kHasSlot, 0),
      forward_error_m: f32(2, -300, 0, 0, 0),
      tau_s: f32(-1, 12, 3, -1, 40),
    }),
    0,
  );
  return result;
}
const order = (key: SortKey, reversed = false) =>
  orderIds(fleet(), kVehicles, { key, reversed }, new Map([[1, { mode: 1 }]]));

test("worst first: the level above all, then the link, then the error from the slot", () => {
  expect(orderIds(fleet(), kVehicles, kWorstFirst, new Map())).toEqual([3, 5, 4, 2, 1]);
});

test("errors of a few metres do not change the order", () => {
  const before = fleet();
  const after = fleet();
  if (before.status !== null) before.status.forward_error_m[0] = 19;
  if (after.status !== null) after.status.forward_error_m[2] = 19;
  expect(orderIds(before, kVehicles, kWorstFirst, new Map())).toEqual(
    orderIds(after, kVehicles, kWorstFirst, new Map()),
  );
});

test("a column sorts both ways, and who has no value stays last", () => {
  expect(order("tau")).toEqual([3, 2, 5, 1, 4]);
  expect(order("tau", true)).toEqual([5, 2, 3, 1, 4]);
  expect(order("forward")).toEqual([2, 1, 3, 4, 5]);
  expect(order("altitude")).toEqual([2, 5, 1, 4, 3]);
  expect(order("id", true)).toEqual([5, 4, 3, 2, 1]);
});

test("a filter shows alerting ones, lost ones, a formation, or what a text is found in", () => {
  const names = new Map([[2, { name: "Bravo" } as Formation]]);
  const ids = (show: Parameters<typeof filterVehicles>[2], text = "") =>
    filterVehicles(fleet(), kVehicles, show, text, names).map(({ id }) => id);
  expect(ids("all")).toEqual(kIds);
  expect(ids("alerting")).toEqual([3, 5]);
  expect(ids("lost")).toEqual([4]);
  expect(ids(1)).toEqual([1, 2]);
  expect(ids("all", "uav3")).toEqual([3]);
  expect(ids("all", "bravo 4")).toEqual([4]);
  expect(ids("alerting", "bravo")).toEqual([3]);
});

test("a formation that is flown no more hides nobody", () => {
  const flown = new Map([[2, null]]);
  expect(inForce(2, flown)).toBe(2);
  expect(inForce(3, flown)).toBe("all");
  expect(inForce("lost", flown)).toBe("lost");
});

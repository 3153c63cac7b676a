import { expect, test } from "vitest";
import { identityOf } from "../map/colours";
import { Fleet } from "../state/fleet";
import { statusFrame } from "../state/frames_for_tests";
import { dashOf, drawnIds } from "./curves";

const kIds = Array.from({ length: 20 }, (_, i) => i + 1);
const kVehicles = kIds.map((id) => ({ id, callsign: `UAV${id}`, model: "default", has_payload: true }));

test("24 neighbours differ in colour or dashes, and next ones in both", () => {
  const looks = Array.from({ length: 24 }, (_, i) => `${identityOf(i + 1)}/${dashOf(i + 1).join()}`);
  expect(new Set(looks).size).toBe(24);
  for (let id = 1; id < 12; id += 1) expect(dashOf(id)).not.toEqual(dashOf(id + 1));
});

test("the selected are drawn, else the worst, in order of id", () => {
  const fleet = new Fleet();
  fleet.take(statusFrame(kIds, { level: Uint8Array.from(kIds, (id) => (id === 19 ? 3 : 0)) }), 0);
  expect(drawnIds(fleet, kVehicles, new Set([12, 3]))).toEqual([3, 12]);
  expect(drawnIds(fleet, kVehicles, new Set())).toEqual([1, 2, 3, 4, 5, 6, 7, 19]);
  expect(drawnIds(fleet, kVehicles, new Set(kIds.slice(8)))).toEqual([9, 10, 11, 12, 13, 14, 15, 19]);
});

import { signal } from "@preact/signals";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Path } from "../link/messages";
import { changeWaypoint, type PathPlan } from "./path_plan";
import { readBack } from "./upload";

const point = (north_m: number) => ({ east_m: 0, north_m, up_m: 1000, speed_m_s: 50, turn_radius_m: 0 });
const kSent: PathPlan = { closed: false, waypoints: [point(0), point(5000)] };
const path = (path_revision: number, plan: PathPlan = kSent): Path => ({
  type: "path",
  formation_id: 1,
  path_revision,
  line: [],
  closed: plan.closed,
  waypoints: [...plan.waypoints],
});

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

test("a path that came before the answer counts", async () => {
  const paths = signal(new Map([[1, path(4)]]));
  expect(await readBack(paths, 1, kSent, 3)).toEqual({ kind: "flown", path_revision: 4 });
});

test("waits for the next revision; other formations and repetitions don't count", async () => {
  const paths = signal(new Map([[1, path(3)]]));
  const result = readBack(paths, 1, kSent, 3);
  paths.value = new Map([
    [1, path(3)],
    [2, { ...path(9), formation_id: 2 }],
  ]);
  paths.value = new Map([[1, path(4)]]);
  expect(await result).toEqual({ kind: "flown", path_revision: 4 });
});

test("says exactly what differs", async () => {
  const paths = signal(new Map([[1, path(4, changeWaypoint(kSent, 1, { up_m: 1010 }))]]));
  expect(await readBack(paths, 1, kSent, 3)).toEqual({
    kind: "differs",
    differences: ["Waypoint 2: altitude 1000 → 1010 m ENU."],
  });
});

test("gives up when the bus tells of no new path", async () => {
  const result = readBack(signal(new Map([[1, path(3)]])), 1, kSent, 3);
  await vi.advanceTimersByTimeAsync(5000);
  expect(await result).toEqual({ kind: "silent" });
});

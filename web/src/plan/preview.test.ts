import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { PathPlan } from "./path_plan";
import { kFlightOld_ms, kQuiet_ms, Preview } from "./preview";

interface Asked {
  plan: PathPlan;
  quick: boolean;
  answer: (ok: boolean) => void;
  fail: (reason: string) => void;
  aborted: () => boolean;
}

const asked: Asked[] = [];
const api = {
  postJson: <T>(_: string, body: unknown, abort?: AbortSignal) =>
    new Promise<T>((resolve, reject) => {
      const { waypoints, closed, geometry_only } = body as PathPlan & { geometry_only?: boolean };
      asked.push({
        plan: { closed, waypoints },
        quick: geometry_only === true,
        answer: (ok) => {
          resolve({ ok, reason: "", line: [], legs: [], problems: [], computed_ms: 100 } as T);
        },
        fail: (reason) => {
          reject(new Error(reason));
        },
        aborted: () => abort?.aborted === true,
      });
    }),
};
const plan = (north_m: number): PathPlan => ({
  closed: false,
  waypoints: [{ east_m: 0, north_m, up_m: 0, speed_m_s: 50, turn_radius_m: 0 }],
});
const settle = () => vi.advanceTimersByTimeAsync(0);

beforeEach(() => {
  vi.useFakeTimers();
  asked.length = 0;
});
afterEach(() => {
  vi.useRealTimers();
});

test("while somebody drags only the newest plan is asked about, one question at a time", async () => {
  const preview = new Preview(api);
  for (const north_m of [1, 2, 3]) preview.want(1, plan(north_m));
  expect(asked).toHaveLength(1);
  asked[0]?.answer(true);
  await settle();
  expect(asked.map((one) => one.plan.waypoints[0]?.north_m)).toEqual([1, 3]);
  asked[1]?.answer(true);
  await settle();
  expect(preview.geometry.value?.plan.waypoints[0]?.north_m).toBe(3);
  expect(asked.every((one) => one.quick)).toBe(true);
});

test("the formation is flown ahead once nothing has changed for a while", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.answer(true);
  await vi.advanceTimersByTimeAsync(kQuiet_ms);
  expect(asked.map((one) => one.quick)).toEqual([true, false]);
  expect(preview.flying.value).toBe(true);
  asked[1]?.answer(true);
  await settle();
  expect(preview.flying.value).toBe(false);
  expect(preview.flight.value?.plan).toEqual(plan(1));
});

test("what can't be flown isn't flown ahead", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.answer(false);
  await vi.advanceTimersByTimeAsync(2 * kQuiet_ms);
  expect(asked).toHaveLength(1);
  expect(preview.geometry.value?.preview.ok).toBe(false);
});

test("a change gives the flight up", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.answer(true);
  await vi.advanceTimersByTimeAsync(kQuiet_ms);
  preview.want(1, plan(2));
  expect(asked[1]?.aborted()).toBe(true);
  asked[1]?.answer(true);
  await settle();
  expect(preview.flight.value).toBeNull();
});

test("a failure is told, and forgotten with the next answer", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.fail("web-bridge can't be reached.");
  await settle();
  expect(preview.failure.value).toBe("web-bridge can't be reached.");
  preview.want(1, plan(2));
  asked[1]?.answer(true);
  await settle();
  expect(preview.failure.value).toBe("");
});

test("a flight that failed is tried again", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.answer(true);
  await vi.advanceTimersByTimeAsync(kQuiet_ms);
  asked[1]?.fail("Three are waiting already.");
  await settle();
  void preview.refresh();
  asked[2]?.answer(true);
  await settle();
  expect(asked.map((one) => one.quick)).toEqual([true, false, true, false]);
  asked[3]?.answer(true);
  await settle();
  expect([preview.failure.value, preview.flight.value?.plan]).toEqual(["", plan(1)]);
});

test("as the formation flies on the geometry is asked for again, and the flight once it is old", async () => {
  const preview = new Preview(api);
  preview.want(1, plan(1));
  asked[0]?.answer(true);
  await vi.advanceTimersByTimeAsync(kQuiet_ms);
  asked[1]?.answer(true);
  await settle();
  void preview.refresh();
  asked[2]?.answer(true);
  await settle();
  expect(asked.map((one) => one.quick)).toEqual([true, false, true]);
  await vi.advanceTimersByTimeAsync(kFlightOld_ms + 1);
  void preview.refresh();
  asked[3]?.answer(true);
  await settle();
  expect(asked.map((one) => one.quick)).toEqual([true, false, true, true, false]);
  // The old one stays in sight until the new one comes.
  expect(preview.flight.value).not.toBeNull();
});

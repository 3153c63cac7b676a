import { expect, test } from "vitest";
import { alarm, listOf } from "../alarms/list_for_tests";
import type { Ack } from "../link/messages";
import { motionFrame } from "./frames_for_tests";
import { Store } from "./store";

const kHello = {
  type: "hello",
  version: "0.1.0",
  lcm_url: "udpm://x",
  utime: 1,
  tile_url: null,
  tile_attribution: "",
};
/** What ends the picture that a hello begins. */
const kComplete = { type: "complete" };
const kRoster = {
  type: "roster",
  utime: 5,
  scenario: "Test",
  start_utime: 1000,
  origin: { latitude_deg: 40, longitude_deg: 116, altitude_m: 0 },
  vehicles: [{ id: 1, callsign: "UAV1", model: "default", has_payload: true }],
};
const event = (event_sequence: number, utime: number) => ({
  type: "event",
  utime,
  event_node: "collision-monitor",
  event_sequence,
  severity: 2,
  code: "link_lost",
  vehicle_id: 1,
  formation_id: 0,
  text: "lost",
});

function filled(...messages: object[]): Store {
  const store = new Store(() => undefined);
  for (const message of [...messages, kComplete]) store.takeText(JSON.stringify(message));
  return store;
}

test("formations, paths and statuses come and go", () => {
  const of = (type: string) => ({ type, formation_id: 4, mode: 1, waypoints: [], line: [], slots: [] });
  const store = filled(of("formation"), of("path"), of("status"));
  store.beat(0);
  expect(store.formations.value.has(4) && store.paths.value.has(4) && store.statuses.value.has(4)).toBe(true);
  store.takeText(JSON.stringify({ type: "formation_removed", formation_id: 4 }));
  expect(store.formations.value.size + store.paths.value.size + store.statuses.value.size).toBe(0);
});

test("the statuses of all formations of a large fleet come together", () => {
  const status = (formation_id: number) => ({ type: "status", formation_id, mode: 1, slots: [] });
  const store = filled({ type: "statuses", statuses: [status(4), status(5)] });
  store.beat(0);
  expect([...store.statuses.value.keys()]).toEqual([4, 5]);
});

test("however often statuses come, they are shown on the beat", () => {
  const status = (mode: number) => ({ type: "status", formation_id: 4, mode, slots: [] });
  const store = filled(status(0));
  store.beat(0);
  const shown = store.statuses.value;
  for (const mode of [1, 2, 3]) store.takeText(JSON.stringify(status(mode)));
  expect(store.statuses.value).toBe(shown);
  store.beat(250);
  expect(store.statuses.value.get(4)?.mode).toBe(3);
  // One that is gone, or of a bridge that is gone, doesn't come back with the next beat.
  store.takeText(JSON.stringify(status(1)));
  store.takeText(JSON.stringify({ type: "formation_removed", formation_id: 4 }));
  store.beat(500);
  expect(store.statuses.value.size).toBe(0);
  store.takeText(JSON.stringify(status(1)));
  store.takeText(JSON.stringify(kHello));
  store.takeText(JSON.stringify(kComplete));
  store.beat(750);
  expect(store.statuses.value.size).toBe(0);
});

test("events stand newest first, each once, the last 1000", () => {
  const store = filled(event(1, 10), event(3, 30), event(2, 20), event(3, 30));
  expect(store.events.value.map((e) => e.event_sequence)).toEqual([3, 2, 1]);
  for (let i = 4; i <= 1100; i += 1) store.takeText(JSON.stringify(event(i, 10 * i)));
  expect(store.events.value).toHaveLength(1000);
  expect(store.events.value[0]?.event_sequence).toBe(1100);
});

test("a new hello forgets what the old bridge said, but not what happened nor the last fleet", () => {
  const store = filled(kHello, kRoster, event(1, 10), { type: "bus", nodes_silent: ["collision-monitor"] });
  store.takeFrame(motionFrame([1]), 0);
  store.takeText(JSON.stringify(kHello));
  store.takeText(JSON.stringify(kComplete));
  expect(store.silent_nodes.value).toEqual([]);
  expect(store.events.value).toHaveLength(1);
  expect(store.roster.value?.scenario).toBe("Test");
  expect(store.fleet.motion).not.toBeNull();
});

test("after a new connection nothing is gone for a moment that the bridge still knows", () => {
  const formation = { type: "formation", formation_id: 4, slots: [] };
  const store = filled(kHello, kRoster, formation);
  const seen: number[] = [];
  const stop = store.formations.subscribe((formations) => {
    seen.push(formations.size);
  });
  for (const message of [kHello, kRoster, formation, kComplete]) store.takeText(JSON.stringify(message));
  stop();
  expect(seen.filter((size) => size !== 1)).toEqual([]);
});

test("a scenario that starts anew clears the old telemetry", () => {
  const store = filled(kRoster);
  store.takeFrame(motionFrame([1]), 0);
  store.takeText(JSON.stringify({ ...kRoster, utime: 6 }));
  expect(store.fleet.motion).not.toBeNull();
  store.takeText(JSON.stringify({ ...kRoster, start_utime: 2000 }));
  expect(store.fleet.motion).toBeNull();
});

test("the selection goes with the UAV", () => {
  const store = filled(kRoster);
  store.select([1]);
  store.takeText(JSON.stringify({ ...kRoster, vehicles: [] }));
  expect(store.selected_id.value).toBeNull();
});

test("what is shown is stale when the bridge or the bus is gone", () => {
  const store = filled(kHello, kRoster);
  expect(store.isStale(0)).toBe(true); // still connecting
  store.connection.value = { kind: "open" };
  store.takeFrame(motionFrame([1], { utime: 5e6 }), 1000);
  expect(store.isStale(1500)).toBe(false);
  expect(store.utimeAt(1500)).toBe(5.5e6);
  expect(store.busSilence_s(4000)).toBe(3);
  expect(store.utimeAt(4000)).toBe(5e6); // the clock stands still with the bus
  store.connection.value = { kind: "waiting", attempt: 1, retry_at_ms: 0 };
  expect(store.isStale(1500)).toBe(true);
});

test("alarms are those of the last list, and a new bridge has to be heard first", () => {
  const store = filled(kHello, listOf([alarm(1, 0), alarm(2, 1)]));
  store.takeText(JSON.stringify(listOf([alarm(2, 1)])));
  expect(store.alarms.value?.alarms.map(({ id }) => id)).toEqual([2]);
  store.takeText(JSON.stringify(kHello));
  store.takeText(JSON.stringify(kComplete));
  expect(store.alarms.value).toBeNull();
});

test("answers go to whoever asked", () => {
  const acks: Ack[] = [];
  const store = new Store((ack) => acks.push(ack));
  const ack = { type: "ack", id: "c1", channel: "CMD_LINK", accepted: true, reason: "" };
  store.takeText(JSON.stringify(ack));
  expect(acks).toEqual([ack]);
});

const playback = (state: string, more: object = {}) => ({
  type: "playback",
  state,
  t_s: 0,
  duration_s: 100,
  start_utime: 1000,
  speed: 1,
  direction: 1,
  loop: null,
  progress: 1,
  problem: "",
  ...more,
});

test("a jump in a recording is shown at once, when the whole picture of the moment is there", () => {
  const log = { ...kHello, replay: { kind: "log", name: "a.lcm" } };
  const store = filled(log, kRoster, event(1, 10), event(2, 20), playback("paused", { t_s: 50 }));
  store.takeFrame(motionFrame([1]), 0);
  const hello = store.hello.value;
  const status = { type: "status", formation_id: 4, mode: 1, slots: [] };
  for (const message of [{ type: "reset" }, { ...log, utime: 2 }, kRoster, status, event(1, 10), kComplete]) {
    store.takeText(JSON.stringify(message));
    expect(store.events.value).toHaveLength(2);
    expect(store.fleet.motionRow(1)).toBe(0);
  }
  store.takeFrame(motionFrame([2]), 0);
  expect(store.fleet.motionRow(2)).toBe(-1);
  store.takeText(JSON.stringify(playback("paused", { t_s: 5 })));
  expect(store.events.value.map((e) => e.event_sequence)).toEqual([1]);
  expect([store.fleet.motionRow(1), store.fleet.motionRow(2)]).toEqual([-1, 0]);
  expect(store.playback.value?.t_s).toBe(5);
  expect(store.statuses.value.get(4)?.mode).toBe(1); // with the rest, not with the next beat
  expect(store.hello.value).toBe(hello); // or tiles and curves would be fetched anew with each jump
});

test("a moment without a fleet shows none", () => {
  const store = filled(kHello, kRoster);
  store.takeFrame(motionFrame([1]), 0);
  for (const message of [{ type: "reset" }, kHello, playback("paused")])
    store.takeText(JSON.stringify(message));
  expect(store.fleet.motion).toBeNull();
});

test("a paused recording is not a silent bus, and its clock stands", () => {
  const store = filled(kHello, kRoster, playback("playing"));
  store.connection.value = { kind: "open" };
  const now_ms = performance.now();
  store.takeFrame(motionFrame([1], { utime: 5e6 }), now_ms);
  store.takeText(JSON.stringify(playback("paused")));
  const then_utime = store.utimeAt(now_ms + 60_000) ?? 0;
  expect(store.busSilence_s(now_ms + 60_000)).toBeNull();
  expect(store.utimeAt(now_ms + 120_000)).toBe(then_utime);
  store.takeText(JSON.stringify(playback("playing")));
  expect(store.busSilence_s(now_ms + 60_000)).toBeGreaterThan(50); // played on without a frame
});

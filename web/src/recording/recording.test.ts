import { expect, test } from "vitest";
import { motionFrame } from "../state/frames_for_tests";
import { Store } from "../state/store";
import { markerProblem, recordingView } from "./recording";

const kStatus = {
  type: "recording",
  utime: 75e6,
  state: 1,
  folder: "/logs",
  recording: "a.lcm",
  part: "a.lcm",
  started_utime: 15e6,
  parts: 1,
  bytes: 5e6,
  free_bytes: 9e9,
  reason: "",
};

function stationWith(...messages: object[]): Store {
  const store = new Store(() => undefined);
  store.connection.value = { kind: "open" };
  for (const message of messages) store.takeText(JSON.stringify(message));
  return store;
}

test("recording is believed while it is said, and its time goes on between", () => {
  const store = stationWith(kStatus);
  const view = recordingView(store, store.recording_ms + 1500);
  expect(view).toMatchObject({ kind: "recording", elapsed_s: 61.5 });
});

test("after three seconds without a word nobody records", () => {
  const store = stationWith(kStatus);
  expect(recordingView(store, store.recording_ms + 2900).kind).toBe("recording");
  expect(recordingView(store, store.recording_ms + 3100)).toMatchObject({ kind: "not", reachable: false });
});

test("what the recorder says is the reason, and whether somebody wanted it so", () => {
  const stopped = stationWith({ ...kStatus, state: 0, reason: "stopped by Ada" });
  expect(recordingView(stopped, stopped.recording_ms)).toEqual({
    kind: "not",
    why: "stopped by Ada",
    wanted: false,
    reachable: true,
  });
  const full = stationWith({ ...kStatus, state: 2, reason: "disk full" });
  expect(recordingView(full, full.recording_ms)).toMatchObject({ why: "disk full", wanted: true });
});

test("a recorder that was never heard is missed once there is a fleet", () => {
  const store = stationWith();
  expect(recordingView(store, store.hello_ms + 10_000).kind).toBe("none");
  store.takeFrame(motionFrame([1]), 0);
  expect(recordingView(store, store.hello_ms + 1000).kind).toBe("none");
  expect(recordingView(store, store.hello_ms + 5000).kind).toBe("not");
  store.connection.value = { kind: "connecting" };
  expect(recordingView(store, store.hello_ms + 5000).kind).toBe("none");
});

test("a marker has a text that fits", () => {
  expect(markerProblem("  ")).not.toBe("");
  expect(markerProblem("gusts \u{1F32C}")).toBe("");
  expect(markerProblem("\u{1F32C}".repeat(200))).toBe("");
  expect(markerProblem("x".repeat(201))).toContain("200");
});

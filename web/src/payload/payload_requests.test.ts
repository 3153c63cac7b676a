import { expect, test, vi } from "vitest";
import type { Commands } from "../link/commands";
import { kPayloadOn } from "../link/frames";
import { kLinkLost } from "../state/fleet";
import { motionFrame, statusFrame } from "../state/frames_for_tests";
import { Store } from "../state/store";
import { lateSentence } from "./late_sentence";
import { PayloadRequests, phaseOf } from "./payload_requests";

function bench(accepted = true) {
  const store = new Store(() => undefined);
  const request = vi.fn(() => Promise.resolve({ accepted, reason: "" }));
  const payloads = new PayloadRequests(store, { request } as unknown as Commands);
  const telemetry = (...on: boolean[]) => {
    store.takeFrame(
      motionFrame(
        on.map((_, i) => i + 1),
        { flags: Uint8Array.from(on, (one) => (one ? kPayloadOn : 0)) },
      ),
      0,
    );
  };
  const at = (now_ms: number) => {
    store.now_ms.value = now_ms;
  };
  at(1000);
  return { store, payloads, telemetry, at, request };
}

test("a payload is waited for from the ACK until telemetry follows", async () => {
  const { payloads, telemetry, at } = bench();
  telemetry(false);
  await payloads.request([1], true);
  expect(phaseOf(payloads.askedOf(1), false, 1200)).toBe("pending");
  telemetry(true);
  at(2000);
  expect(payloads.askedOf(1)).toBeUndefined();
  telemetry(false); // somebody else's doing: nothing of ours is waited for
  at(9000);
  expect(payloads.late(9000)).toEqual({ on: [], off: [] });
});

test("in another flight nobody was asked anything", async () => {
  const { store, payloads, telemetry } = bench();
  const roster = (start_utime: number) => {
    store.takeText(JSON.stringify({ type: "roster", start_utime, vehicles: [] }));
  };
  roster(1);
  telemetry(false);
  await payloads.request([1], true);
  expect(payloads.askedOf(1)).toBeDefined();
  roster(2);
  expect(payloads.askedOf(1)).toBeUndefined();
});

test("who doesn't follow within five seconds is named, with the link when it is lost", async () => {
  const { store, payloads, telemetry, at } = bench();
  telemetry(false, false);
  store.takeFrame(statusFrame([1, 2], { downlink: Uint8Array.of(0, kLinkLost) }), 0);
  await payloads.request([1, 2], true);
  telemetry(true, false);
  at(5900);
  expect(lateSentence(store, payloads, 5900)).toBe("");
  at(6100);
  expect(phaseOf(payloads.askedOf(2), false, 6100)).toBe("late");
  expect(lateSentence(store, payloads, 6100)).toBe(
    "UAV 2: telemetry does not show the payload on 5 s after it was asked for: the data link is lost.",
  );
});

test("what was refused is not waited for", async () => {
  const { payloads } = bench(false);
  await payloads.request([1], true);
  expect(payloads.askedOf(1)).toBeUndefined();
});

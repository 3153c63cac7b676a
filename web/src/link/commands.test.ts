import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Commands } from "./commands";

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

const kCut = { vehicle_id: 3, mode: "silent" } as const;

test("sends what the bridge understands and gives back its answer", async () => {
  const sent: string[] = [];
  const commands = new Commands((text) => sent.push(text) > 0);
  const outcome = commands.request("CMD_LINK", kCut);
  expect(JSON.parse(sent[0] ?? "")).toEqual({ type: "command", id: "c1", channel: "CMD_LINK", body: kCut });
  commands.acknowledged({ type: "ack", id: "c1", channel: "CMD_LINK", accepted: false, reason: "no UAV 3" });
  expect(await outcome).toEqual({ accepted: false, reason: "no UAV 3" });
});

test("matches answers with their commands, whatever their order", async () => {
  const commands = new Commands(() => true);
  const first = commands.request("CMD_LINK", kCut);
  const second = commands.request("CMD_PAYLOAD", { vehicle_ids: [1], on: true });
  commands.acknowledged({ type: "ack", id: "c2", channel: "CMD_PAYLOAD", accepted: false, reason: "second" });
  commands.acknowledged({
    type: "ack",
    id: null,
    channel: "CMD_LINK",
    accepted: false,
    reason: "of another browser",
  });
  commands.acknowledged({ type: "ack", id: "c1", channel: "CMD_LINK", accepted: true, reason: "" });
  expect((await first).accepted).toBe(true);
  expect((await second).reason).toBe("second");
});

test("says so when there is no connection, when it goes, and when no answer comes", async () => {
  const offline = new Commands(() => false);
  expect((await offline.request("CMD_LINK", kCut)).reason).toMatch(/^Not sent/);

  const commands = new Commands(() => true);
  const lost = commands.request("CMD_LINK", kCut);
  commands.connectionLost();
  expect((await lost).reason).toMatch(/^Connection lost/);

  const unanswered = commands.request("CMD_LINK", kCut);
  vi.advanceTimersByTime(4000);
  expect((await unanswered).accepted).toBe(false);
});

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Api } from "../link/api";
import type { Commands, Outcome } from "../link/commands";
import type { PlaybackBody, PlaybackMessage } from "../link/recording_messages";
import { replay } from "../state/replay";
import { Store } from "../state/store";
import { Player } from "./player";

const kPlayback: PlaybackMessage = {
  type: "playback",
  state: "paused",
  t_s: 50,
  duration_s: 100,
  start_utime: 1e15,
  speed: 1,
  direction: 1,
  loop: null,
  progress: 1,
  problem: "",
};

/** A player, what it has asked the bridge, and the bridge's answers, given one by one. */
function open(more: Partial<PlaybackMessage> = {}) {
  const store = new Store(() => undefined);
  const asked: PlaybackBody[] = [];
  const answers: ((outcome: Outcome) => void)[] = [];
  const commands = {
    playback: (body: PlaybackBody) => {
      asked.push(body);
      return new Promise<Outcome>((resolve) => answers.push(resolve));
    },
  } as unknown as Commands;
  const getJson = vi.fn(() => Promise.resolve({ progress: 0 }));
  const api = { getJson } as unknown as Api;
  store.connection.value = { kind: "open" };
  const player = new Player(store, commands, api);
  const say = (message: Partial<PlaybackMessage>) => {
    store.takeText(JSON.stringify({ ...kPlayback, ...more, ...message }));
  };
  say({});
  const answer = async (outcome: Outcome = { accepted: true, reason: "" }) => {
    answers.shift()?.(outcome);
    await Promise.resolve();
    await Promise.resolve();
  };
  return { store, player, asked, say, answer, getJson };
}

beforeEach(() => {
  vi.useFakeTimers();
  replay.value = { kind: "log", name: "a.lcm" };
});
afterEach(() => {
  vi.useRealTimers();
  replay.value = null;
});

test("while a jump is under way, only the last one that was wanted waits", async () => {
  const { player, asked, answer } = open();
  for (const t_s of [10, 20, 30, 40]) player.seek(t_s);
  expect(asked).toEqual([{ action: "seek", t_s: 10 }]);
  expect(player.at_s(performance.now())).toBe(40); // where the hand is
  await answer();
  expect(asked.slice(1)).toEqual([{ action: "seek", t_s: 40 }]);
  await answer();
  expect(asked).toHaveLength(2);
  expect(player.wanted_s.value).toBeNull();
});

test("jumps stay within the recording", () => {
  const { player, asked } = open();
  player.seek(1e6);
  expect(asked).toEqual([{ action: "seek", t_s: 100 }]);
});

test("to play the other way it is turned first; the same key pauses", async () => {
  const { player, asked, say, answer } = open({ speed: 5 });
  void player.toggle(-1);
  await answer();
  expect(asked).toEqual([{ action: "speed", speed: -5 }, { action: "play" }]);
  say({ state: "playing", direction: -1 });
  void player.toggle(-1);
  expect(asked.at(-1)).toEqual({ action: "pause" });
});

test("what was asked for counts before the bridge has said so", async () => {
  const { player, asked, say, answer } = open({ direction: -1 });
  void player.setSpeed(50);
  void player.toggle(1);
  expect(asked.slice(-2)).toEqual([
    { action: "speed", speed: -50 },
    { action: "speed", speed: 50 },
  ]);
  void player.changeSpeed(-1);
  void player.changeSpeed(-1);
  expect(asked.slice(-2)).toEqual([
    { action: "speed", speed: 20 },
    { action: "speed", speed: 10 },
  ]);
  vi.advanceTimersByTime(4000); // what keeps the connection alive
  expect(asked.at(-1)).toEqual({ action: "speed", speed: 10 });
  say({ direction: 1, speed: 50 }); // an earlier one
  void player.changeSpeed(1);
  expect(asked.at(-1)).toEqual({ action: "speed", speed: 20 });
  say({ direction: 1, speed: 20 });
  say({ direction: 1, speed: 5 });
  void player.changeSpeed(1);
  expect(asked.at(-1)).toEqual({ action: "speed", speed: 10 });
  for (let i = 0; i < 7; ++i) await answer({ accepted: false, reason: "no" });
  void player.changeSpeed(1);
  expect(asked.at(-1)).toEqual({ action: "speed", speed: 10 });
});

test("a loop has its ends set one after the other, in either order", () => {
  const { player, asked, say } = open();
  player.setLoopEnd("a");
  expect(player.loop_a_s.value).toBe(50);
  expect(asked).toEqual([]);
  say({ t_s: 60 });
  player.setLoopEnd("b");
  expect(asked).toEqual([{ action: "loop", loop: [50, 60] }]);
  say({ t_s: 55, loop: [50, 60] });
  player.setLoopEnd("a");
  expect(asked.at(-1)).toEqual({ action: "loop", loop: [55, 60] });
  say({ t_s: 70, loop: [55, 60] });
  player.setLoopEnd("a"); // behind its end: begun anew
  expect(asked.at(-1)).toEqual({ action: "loop", loop: null });
  expect(player.loop_a_s.value).toBe(70);
});

test("B alone loops from the beginning, and B before A is refused", () => {
  const { player, asked, say } = open();
  player.setLoopEnd("b");
  expect(asked).toEqual([{ action: "loop", loop: [0, 50] }]);
  say({ t_s: 20, loop: [30, 50] });
  player.setLoopEnd("b");
  expect(asked).toHaveLength(1);
  expect(player.refusal.value).toContain("B must be after A");
});

test("a refusal is kept for the person", async () => {
  const { player, answer } = open();
  void player.step(1);
  await answer({ accepted: false, reason: "It is still being read." });
  expect(player.refusal.value).toBe("It is still being read.");
});

// Of two messages that wait to be sent the newer replaces the older: "opening" may never be heard.
test.each([true, false])("after a lost connection it goes on where it was; opening heard: %s", (heard) => {
  const { store, player, asked, say } = open();
  say({ state: "playing", speed: 2, loop: [40, 90] });
  vi.advanceTimersByTime(1000);
  store.connection.value = { kind: "waiting", attempt: 1, retry_at_ms: 0 };
  vi.advanceTimersByTime(5000);
  expect(player.at_s(performance.now())).toBeCloseTo(52, 3);
  store.connection.value = { kind: "open" };
  if (heard) say({ state: "opening", t_s: 0, speed: 1, loop: null });
  expect(asked).toEqual([]);
  say({ state: "paused", t_s: 0, speed: 1, loop: null });
  expect(asked).toEqual([
    { action: "seek", t_s: expect.closeTo(52, 3) as number },
    { action: "speed", speed: 2 },
    { action: "loop", loop: [40, 90] },
    { action: "play" },
  ]);
});

test("the outline is asked for with each connection, not when one is lost: the next bridge may not have the recording", () => {
  const { store, getJson } = open();
  const before = getJson.mock.calls.length;
  store.connection.value = { kind: "waiting", attempt: 1, retry_at_ms: 0 };
  store.connection.value = { kind: "connecting" };
  expect(getJson).toHaveBeenCalledTimes(before);
  store.connection.value = { kind: "open" };
  expect(getJson).toHaveBeenCalledTimes(before + 1);
  expect(getJson).toHaveBeenLastCalledWith("api/recordings/a.lcm", expect.anything());
});

test("while nothing plays it asks for what changes nothing, so that a dead link is noticed", () => {
  const { asked, say } = open({ speed: 2, direction: -1 });
  vi.advanceTimersByTime(9000);
  expect(asked).toEqual([
    { action: "speed", speed: -2 },
    { action: "speed", speed: -2 },
  ]);
  say({ state: "playing" });
  vi.advanceTimersByTime(9000);
  expect(asked).toHaveLength(2);
});

import { expect, test } from "vitest";
import type { PlaybackMessage } from "../link/recording_messages";
import { loopProblem, nextSpeed, timeAt } from "./playing";

const kPlayback: PlaybackMessage = {
  type: "playback",
  state: "playing",
  t_s: 50,
  duration_s: 100,
  start_utime: 1,
  speed: 10,
  direction: 1,
  loop: null,
  progress: 1,
  problem: "",
};

test("what is played goes on as fast as it is played, and not past its ends", () => {
  expect(timeAt(kPlayback, 0.5)).toBe(55);
  expect(timeAt(kPlayback, 50)).toBe(100);
  expect(timeAt({ ...kPlayback, direction: -1 }, 0.5)).toBe(45);
  expect(timeAt({ ...kPlayback, direction: -1 }, 50)).toBe(0);
  expect(timeAt({ ...kPlayback, state: "paused" }, 50)).toBe(50);
});

test("within a loop it does not go past that", () => {
  expect(timeAt({ ...kPlayback, loop: [40, 52] }, 3)).toBe(52);
  expect(timeAt({ ...kPlayback, loop: [60, 70] }, 0.1)).toBe(51); // not there yet
});

test("speeds go up and down by the usual ones, from any", () => {
  expect(nextSpeed(1, 1)).toBe(2);
  expect(nextSpeed(1, -1)).toBe(0.5);
  expect(nextSpeed(3, -1)).toBe(2);
  expect(nextSpeed(50, 1)).toBe(50);
  expect(nextSpeed(0.1, -1)).toBe(0.1);
});

test("a loop ends after it begins", () => {
  expect(loopProblem(3, 3.3)).toBe("");
  expect(loopProblem(3, 3.1)).toContain("after A");
});

import { expect, test } from "vitest";
import { fleetInterval_ms, LayerClock } from "./layer_clock";

function drawnAndSeenAfter(cost_ms: number): LayerClock {
  const clock = new LayerClock();
  clock.tick(1000);
  clock.drawn(1000);
  clock.tick(1000 + cost_ms);
  return clock;
}

test("a fleet is drawn as often as it is seen to move, within limits", () => {
  const quick = drawnAndSeenAfter(10);
  expect(fleetInterval_ms(quick, 100)).toBe(30);
  expect(fleetInterval_ms(quick, 10)).toBe(50); // half a pixel
  expect(fleetInterval_ms(quick, 1)).toBe(100);
  expect(fleetInterval_ms(quick, 0)).toBe(100);
});

test("what has changed is drawn soon, also where nothing moves", () => {
  const clock = drawnAndSeenAfter(10);
  clock.old = true;
  expect(fleetInterval_ms(clock, 0)).toBe(30);
  expect(clock.isDue(1020, 30)).toBe(false);
  expect(clock.isDue(1030, 30)).toBe(true);
});

test("another view is drawn at once, and once", () => {
  const clock = drawnAndSeenAfter(10);
  clock.demand();
  expect(clock.isDue(1011, 30)).toBe(true);
  clock.drawn(1011);
  expect(clock.isDue(1012, 30)).toBe(false);
});

test("where drawing is slow, half of the time is left to everything else", () => {
  expect(fleetInterval_ms(drawnAndSeenAfter(80), 100)).toBe(160);
  expect(fleetInterval_ms(drawnAndSeenAfter(500), 100)).toBe(200);
});

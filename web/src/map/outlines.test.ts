import { expect, test } from "vitest";
import { randomFrom } from "../state/random_for_tests";
import { outlineOf, trace } from "./outlines";
import { mercatorX, mercatorY, type View } from "./view";

/** 1000 by 600 px around a place. */
function viewAt(longitude_deg: number, latitude_deg: number, scale_px: number): View {
  return {
    scale_px,
    left_px: mercatorX(longitude_deg) * scale_px - 500,
    top_px: mercatorY(latitude_deg) * scale_px - 300,
    width_px: 1000,
    height_px: 600,
  };
}

type Point = [number, number];

/** What is drawn, a list of points for each time that the pen is set down. */
function drawn(line: Point[], view: View): Point[][] {
  const lines: Point[][] = [];
  const path = {
    moveTo: (x: number, y: number) => lines.push([[x, y]]),
    lineTo: (x: number, y: number) => lines.at(-1)?.push([x, y]),
  };
  trace(path, outlineOf(line), view);
  return lines;
}

/** Whether a point is inside of all rings together, by the even-odd rule. */
function covers(rings: Point[][], x: number, y: number): boolean {
  let inside = false;
  for (const ring of rings) {
    ring.forEach(([ax, ay], i) => {
      const [bx, by] = ring[(i + 1) % ring.length];
      if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
    });
  }
  return inside;
}

test("what lies outside of the view isn't drawn", () => {
  const island: Point[] = [
    [10, 50],
    [11, 50],
    [11, 51],
    [10, 50],
  ];
  expect(drawn(island, viewAt(10.5, 50.5, 100_000))).toHaveLength(1);
  expect(drawn(island, viewAt(30, 50.5, 100_000))).toEqual([]);
  expect(drawn(island, viewAt(10.5, -20, 100_000))).toEqual([]);
});

test("at the date line the land of both sides is there", () => {
  const west: Point[] = [
    [-179, 0],
    [-178, 0],
    [-178, 1],
    [-179, 0],
  ];
  const [[[x]]] = drawn(west, viewAt(180, 0, 50_000));
  expect(x).toBeCloseTo(500 + 50_000 / 360);
});

test("a pole is drawn where the map ends", () => {
  const south: Point[] = [
    [-180, -70],
    [180, -70],
    [180, -90],
    [-180, -90],
    [-180, -70],
  ];
  for (const [x, y] of drawn(south, viewAt(0, -80, 1000)).flat()) {
    expect(Number.isFinite(x) && Number.isFinite(y)).toBe(true);
  }
});

test("leaving points out changes nothing of what is seen, and most of a coast that isn't seen is left out", () => {
  // A coast around half the world that comes into the view and leaves it again and again, on all sides.
  const seed = 20261128;
  const random = randomFrom(seed);
  for (let world = 0; world < 20; world += 1) {
    const coast: Point[] = [];
    for (let i = 0; i < 3000; i += 1) {
      const turn = (2 * Math.PI * i) / 3000;
      const reach_deg = 3 + 40 * random() ** 3;
      coast.push([20 + reach_deg * Math.cos(turn), 30 + 0.8 * reach_deg * Math.sin(turn)]);
    }
    const view = viewAt(22 + 3 * random(), 30 + 3 * random(), 60_000);
    const whole = coast.map(([longitude_deg, latitude_deg]): Point => [
      mercatorX(longitude_deg) * view.scale_px - view.left_px,
      mercatorY(latitude_deg) * view.scale_px - view.top_px,
    ]);
    const kept = drawn(coast, view);
    expect(kept.flat().length).toBeLessThan(0.9 * coast.length);
    let differ = 0;
    for (let probe = 0; probe < 300; probe += 1) {
      const [x, y] = [1000 * random(), 600 * random()];
      if (covers([whole], x, y) !== covers(kept, x, y)) differ += 1;
    }
    // Of points within a pixel of the coast.
    expect(differ, `seed ${seed}, world ${world}`).toBeLessThan(6);
  }
});

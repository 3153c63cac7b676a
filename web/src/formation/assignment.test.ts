import { describe, expect, test } from "vitest";
import { assign, type Points } from "./assignment";
import { kShapes, shapeSlots } from "./shapes";

/** Mulberry32: small, and the same everywhere. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

type Point = readonly [number, number];
const points = (list: readonly Point[]): Points => Float64Array.from(list.flatMap(([x, y]) => [x, y, 0]));

/** On which side of a-b is c: the cross product. */
const side = (a: Point, b: Point, c: Point) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

function cross(a: Point, b: Point, c: Point, d: Point): boolean {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

function crossings(from: readonly Point[], to: readonly Point[], places: readonly number[]): number {
  let count = 0;
  for (let i = 0; i < from.length; i += 1) {
    for (let j = 0; j < i; j += 1) {
      const ends = [from[i], to[places[i] ?? 0], from[j], to[places[j] ?? 0]] as [Point, Point, Point, Point];
      if (cross(...ends)) count += 1;
    }
  }
  return count;
}

describe("assign", () => {
  const seed = Math.floor(Math.random() * 2 ** 31);

  test.each(Array.from({ length: 40 }, (_, i) => seed + i))("no ways cross, seed %i", (case_seed) => {
    const next = random(case_seed);
    const shape = kShapes[Math.floor(next() * kShapes.length)] ?? "vee";
    const count = 2 + Math.floor(next() * 40);
    const from = Array.from({ length: count }, () => [next() * 8000, next() * 8000] as const);
    const to = shapeSlots(shape, count, 300, 0).map(
      ({ forward_m, left_m }) => [4000 + forward_m, 4000 + left_m] as const,
    );
    const places = assign(points(from), points(to));
    expect([...places].sort((a, b) => a - b)).toEqual(from.map((_, i) => i));
    expect(crossings(from, to, places), `${shape} of ${count}`).toBe(0);
  });

  test("the crossing that the order of ids would give is seen by this test, and avoided", () => {
    const from = [[0, 0], [1000, 0]] as const; // prettier-ignore
    const to = [[1000, 1000], [0, 1000]] as const; // prettier-ignore
    expect(crossings(from, to, [0, 1])).toBe(1);
    expect(assign(points(from), points(to))).toEqual([1, 0]);
  });

  test("nobody overtakes along one line", () => {
    const from = [[0, 0], [-500, 0], [-1000, 0]] as const; // prettier-ignore
    const to = [[0, 0], [500, 0], [-500, 0]] as const; // prettier-ignore
    expect(assign(points(from), points(to))).toEqual([1, 0, 2]);
  });

  test("altitude counts: who is high gets the high place", () => {
    const from = Float64Array.of(0, 0, 1000, 10, 0, 2000);
    const to = Float64Array.of(0, 0, 2000, 10, 0, 1000);
    expect(assign(from, to)).toEqual([1, 0]);
  });

  test("nobody goes nowhere, and one goes where there is a place", () => {
    expect(assign(points([]), points([]))).toEqual([]);
    expect(assign(points([[5, 5]]), points([[900, 0]]))).toEqual([0]);
    expect(() => assign(points([[5, 5]]), points([]))).toThrow("as many");
  });

  test("a hundred are placed at once", () => {
    const next = random(seed);
    const from = Float64Array.from({ length: 300 }, () => next() * 1e4);
    const to = Float64Array.from({ length: 300 }, () => next() * 1e4);
    const start_ms = performance.now();
    assign(from, to);
    expect(performance.now() - start_ms).toBeLessThan(1000);
  });
});

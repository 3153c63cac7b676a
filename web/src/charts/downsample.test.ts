import { expect, test } from "vitest";
import { downsample } from "./downsample";

const times = (n: number) => Float64Array.from({ length: n }, (_, i) => i);

test("few samples are drawn as they are, gaps as gaps", () => {
  const drawn = downsample(times(4), [{ values: Float32Array.of(1, NaN, 3, 4) }], 1, 4, 100);
  expect(drawn.t_s).toEqual([1, 2, 3]);
  expect(drawn.values).toEqual([[null, 3, 4]]);
});

test("of many samples no peak is lost, and the points stay in order", () => {
  const n = 100_000;
  const values = Float32Array.from({ length: n }, (_, i) => Math.sin(i / 5000));
  values[31_234] = 50;
  values[77_777] = -50;
  const drawn = downsample(times(n), [{ values }], 0, n, 1000);
  expect(drawn.t_s.length).toBe(1000);
  expect(drawn.values[0]?.length).toBe(1000);
  expect(Math.max(...(drawn.values[0] ?? []).map(Number))).toBe(50);
  expect(Math.min(...(drawn.values[0] ?? []).map(Number))).toBe(-50);
  expect(drawn.t_s.every((t_s, i) => i === 0 || t_s >= (drawn.t_s[i - 1] ?? 0))).toBe(true);
  const at = drawn.values[0]?.indexOf(50) ?? 0;
  expect(Math.abs((drawn.t_s[at] ?? 0) - 31_234)).toBeLessThan(200);
});

test("a gap that fills a bucket is a gap, a shorter one is bridged by its bucket", () => {
  const values = Float32Array.from({ length: 1000 }, (_, i) => (i >= 400 && i < 600 ? NaN : 1));
  const drawn = downsample(times(1000), [{ values }], 0, 1000, 20);
  expect(drawn.values[0]?.slice(8, 12)).toEqual([null, null, null, null]);
  expect(drawn.values[0]?.[7]).toBe(1);
});

test("a course that goes through north is cut, not drawn across", () => {
  const values = Float32Array.of(358, 359, 1, 2);
  expect(downsample(times(4), [{ values, period: 360 }], 0, 4, 100).values).toEqual([[358, 359, null, 2]]);
  const long = Float32Array.from({ length: 1000 }, (_, i) => (i * 3.7) % 360);
  const drawn = downsample(times(1000), [{ values: long, period: 360 }], 0, 1000, 100);
  const points = drawn.values[0] ?? [];
  points.forEach((value, i) => {
    const before = points[i - 1];
    if (typeof value === "number" && typeof before === "number")
      expect(Math.abs(value - before)).toBeLessThan(180);
  });
});

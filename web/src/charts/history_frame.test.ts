import { expect, test } from "vitest";
import { FlightSeries } from "./flight_series";
import { appendHistory, decodeHistory } from "./history_frame";

/** Byte for byte what cpp/bridge/README.md says. */
function answer(
  t_s: number[],
  ids: number[],
  value: (row: number, column: number, sample: number) => number,
) {
  const [m, n] = [t_s.length, ids.length];
  const buffer = new ArrayBuffer(24 + 8 * m + 4 * n + 37 * n * m);
  const view = new DataView(buffer);
  view.setUint8(0, 3);
  view.setUint8(1, 1);
  view.setUint32(4, n, true);
  view.setFloat64(8, 1e15, true);
  view.setUint32(16, m, true);
  t_s.forEach((t, i) => {
    view.setFloat64(24 + 8 * i, t, true);
  });
  ids.forEach((id, k) => {
    view.setInt32(24 + 8 * m + 4 * k, id, true);
    for (let i = 0; i < m; i += 1) {
      for (let c = 0; c < 9; c += 1)
        view.setFloat32(24 + 8 * m + 4 * n + 4 * ((k * 9 + c) * m + i), value(k, c, i), true);
      view.setUint8(24 + 8 * m + 4 * n + 36 * n * m + k * m + i, k === 0 ? 3 : 0);
    }
  });
  return buffer;
}

test("an answer becomes curves; what was not known becomes gaps", () => {
  const frame = decodeHistory(
    answer([0, 1], [7, 9], (k, c, i) => (c > 5 && k === 1 ? -1 : 100 * k + 10 * c + i)),
  );
  expect(frame?.start_utime).toBe(1e15);
  const series = new FlightSeries([9, 7, 3]);
  if (frame !== null) appendHistory(series, frame);
  expect([...series.times()]).toEqual([0, 1]);
  expect([...(series.values(7, "up_m") ?? [])]).toEqual([0, 1]);
  expect([...(series.values(7, "up_error_m") ?? [])]).toEqual([50, 51]);
  expect([...(series.values(7, "tau_s") ?? [])]).toEqual([80, 81]);
  for (const name of ["up_m", "left_error_m", "tau_s"] as const) {
    expect([...(series.values(9, name) ?? [])]).toEqual([NaN, NaN]);
    expect([...(series.values(3, name) ?? [])]).toEqual([NaN, NaN]);
  }
});

test("an answer of another kind or length is none", () => {
  const good = answer([0], [1], () => 0);
  expect(decodeHistory(good.slice(0, -1))).toBeNull();
  expect(decodeHistory(new ArrayBuffer(3))).toBeNull();
  const other = good.slice(0);
  new DataView(other).setUint8(1, 2);
  expect(decodeHistory(other)).toBeNull();
});

import { expect, test } from "vitest";
import { FlightSeries } from "./flight_series";

function seriesOf(times: number[], most = 100): FlightSeries {
  const series = new FlightSeries([1, 2], most);
  for (const t_s of times) series.append(t_s, (id, name) => (name === "up_m" ? 1000 * id + t_s : 0));
  return series;
}

test("samples are kept in order, and a time that doesn't rise is no sample", () => {
  const series = seriesOf([0, 1, 1, 0.5, 2]);
  expect([...series.times()]).toEqual([0, 1, 2]);
  expect([...(series.values(2, "up_m") ?? [])]).toEqual([2000, 2001, 2002]);
  expect(series.values(3, "up_m")).toBeNull();
});

test("when it is full every second sample goes, and the start and the newest stay", () => {
  const series = seriesOf(
    Array.from({ length: 1000 }, (_, i) => i),
    64,
  );
  expect(series.count).toBeLessThanOrEqual(64);
  expect(series.count).toBeGreaterThan(30);
  expect(series.times()[0]).toBe(0);
  expect(series.last_s()).toBe(999);
  series.times().forEach((t_s, i) => {
    expect(series.values(1, "up_m")?.[i]).toBe(1000 + t_s);
  });
});

test("the sample nearest to a time is found", () => {
  const series = seriesOf([10, 20, 30]);
  expect([0, 14, 15, 16, 99].map((t_s) => series.indexAt(t_s))).toEqual([0, 0, 0, 1, 2]);
  expect(new FlightSeries([1]).indexAt(5)).toBe(-1);
  expect([9, 10, 29, 30].map((t_s) => series.firstAfter(t_s))).toEqual([0, 1, 2, 3]);
});

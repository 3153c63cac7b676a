import { expect, test } from "vitest";
import { kCharts } from "./chart_list";
import { toCsv } from "./csv";
import { FlightSeries } from "./flight_series";

test("a file has UTC, time, UAV and the shown series in SI; what is not known is empty", () => {
  const series = new FlightSeries([1, 2]);
  const values = { up_m: 1000.12345, course_rad: Math.PI / 2 } as Record<string, number>;
  for (const t_s of [0, 1.5, 3]) {
    series.append(t_s, (id, name) => (id === 2 && name === "up_m" ? NaN : (values[name] ?? 0)));
  }
  const charts = kCharts.filter(({ column }) => column === "up_m" || column === "course_rad");
  const names = (id: number) => (id === 1 ? "UAV1" : 'Red, "2"');
  const text = toCsv(series, charts, { from_s: 1, to_s: 2 }, 1_577_836_800_000_000, names);
  expect(text.split("\r\n")).toEqual([
    "utc,t_s,vehicle_id,callsign,up_m,course_deg",
    "2020-01-01T00:00:01.500Z,1.5,1,UAV1,1000.123,0",
    '2020-01-01T00:00:01.500Z,1.5,2,"Red, ""2""",,0',
    "",
  ]);
});

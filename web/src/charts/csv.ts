/** What the charts show, as a file for other programs: a line per time and UAV, SI units. */
import type { ChartSpec } from "./chart_list";
import type { FlightSeries } from "./flight_series";
import type { Span } from "./time_window";

/** Enough for 1 mm, 1 ms and a thousandth of a degree. */
const kDecimals = 3;

export function toCsv(
  series: FlightSeries,
  charts: readonly ChartSpec[],
  span: Span,
  start_utime: number,
  callsign: (id: number) => string,
): string {
  const lines = [["utc", "t_s", "vehicle_id", "callsign", ...charts.map((chart) => chart.file_name)].join()];
  const times = series.times();
  times.forEach((t_s, i) => {
    if (t_s < span.from_s || t_s > span.to_s) return;
    const utc = new Date(start_utime / 1000 + t_s * 1000).toISOString();
    for (const id of series.ids) {
      const values = charts.map((chart) => {
        const value = series.values(id, chart.column)?.[i] ?? NaN;
        return Number.isNaN(value) ? "" : plain(chart.file_value(value));
      });
      lines.push([utc, plain(t_s), id, quoted(callsign(id)), ...values].join());
    }
  });
  return `${lines.join("\r\n")}\r\n`;
}

function plain(value: number): string {
  return String(Number(value.toFixed(kDecimals)));
}

/** RFC 4180. */
function quoted(text: string): string {
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

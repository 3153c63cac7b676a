/** What one chart draws: the samples in view, thinned out, in the units that are shown. */
import type { ChartSpec } from "./chart_list";
import { downsample, type Curve, type Drawn } from "./downsample";
import type { FlightSeries } from "./flight_series";
import { fromCut, quietCut } from "./round_scale";
import type { Span } from "./time_window";

/** Two points a pixel: the least and the greatest. */
export function chartData(series: FlightSeries, chart: ChartSpec, span: Span, width_px: number): Drawn {
  // One sample more at either side, so that curves reach the edges.
  const first = Math.max(series.firstAfter(span.from_s) - 2, 0);
  const end = Math.min(series.firstAfter(span.to_s) + 1, series.count);
  const raw = series.ids.map((id) => series.values(id, chart.column) ?? new Float32Array(series.count));
  const most = Math.max(2 * Math.round(width_px), 200);
  if (chart.period !== undefined) {
    return downsample(series.times(), goingRound(raw, chart, chart.period, first, end), first, end, most);
  }
  const drawn = downsample(
    series.times(),
    raw.map((values) => ({ values })),
    first,
    end,
    most,
  );
  for (const values of drawn.values) {
    values.forEach((value, i) => {
      if (value !== null) values[i] = chart.value(value);
    });
  }
  return drawn;
}

function goingRound(
  raw: readonly Float32Array[],
  chart: ChartSpec,
  period: number,
  first: number,
  end: number,
): Curve[] {
  const curves = raw.map((values) => values.slice(0, end));
  for (const values of curves) {
    for (let i = first; i < end; i += 1) values[i] = chart.value(values[i] ?? NaN);
  }
  const cut = quietCut(
    curves.flatMap((values) => [...values.subarray(first, end)]),
    period,
  );
  for (const values of curves) {
    for (let i = first; i < end; i += 1) values[i] = fromCut(values[i] ?? NaN, cut, period);
  }
  return curves.map((values) => ({ values, period }));
}

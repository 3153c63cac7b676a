/** One uPlot chart: its looks, its axes and what is drawn over it. */
import uPlot from "uplot";
import type { Colours } from "../map/colours";
import { identityOf } from "../map/colours";
import { clock, fixed } from "../units/format";
import type { ChartSpec } from "./chart_list";
import { dashOf } from "./curves";
import type { Drawn } from "./downsample";
import type { Span } from "./time_window";

const kFont = '11px "Inter Variable", system-ui, sans-serif';
/** All charts with this key have their cursors in step. */
const kSync = "skein.flight";
const kDegreeSteps = [1, 2, 5, 10, 15, 30, 45, 90, 180];
/** Half of the longest label of the time axis [px]. */
const kHalfTimeLabel_px = 22;
const kPaddingRight_px = 4;
const kTimeSteps_s = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 28_800, 86_400];
/** A curve that is nearly flat is shown flat: this is the least height of a chart, in shown units. */
const kLeastRange = 2;
/** Around the curves, of their height. */
const kMargin = 0.08;

export interface ChartEvents {
  /** The time at the cursor; null: it is on no chart. */
  onCursor: (t_s: number | null) => void;
  onSelect: (span: Span) => void;
  drawOver: (plot: uPlot) => void;
}

export function makePlot(
  root: HTMLElement,
  chart: ChartSpec,
  ids: readonly number[],
  colours: Colours,
  span: () => Span,
  events: ChartEvents,
): uPlot {
  const axis: uPlot.Axis = {
    stroke: colours.muted,
    font: kFont,
    grid: { stroke: colours.map_grid, width: 1 },
    ticks: { stroke: colours.map_grid, width: 1, size: 4 },
  };
  const plot: uPlot = new uPlot(
    {
      width: Math.max(root.clientWidth, 50),
      height: Math.max(root.clientHeight, 50),
      padding: [6, kPaddingRight_px, 0, 0],
      legend: { show: false },
      cursor: {
        sync: { key: kSync, setSeries: false, scales: ["x", null] },
        drag: { x: true, y: false, setScale: false },
        y: false,
        points: { size: 6 },
        bind: { dblclick: () => () => null },
      },
      scales: {
        x: { time: false, range: () => [span().from_s, span().to_s] },
        y: { range: (_, low, high) => withMargin(low, high) },
      },
      axes: [
        {
          ...axis,
          size: 24,
          space: 70,
          incrs: kTimeSteps_s,
          values: (self, splits) => splits.map((t_s) => (fits(self, t_s) ? clock(t_s) : null)),
        },
        {
          ...axis,
          size: 50,
          space: 28,
          ...(chart.period === undefined ? {} : { incrs: kDegreeSteps }),
          values: (_, splits, __, ___, step) => labels(splits, step, chart.period),
        },
      ],
      series: [
        {},
        ...ids.map((id) => ({
          stroke: colours.identity[identityOf(id) - 1] ?? colours.text,
          width: 1.5,
          dash: dashOf(id),
          points: { show: false },
          spanGaps: false,
        })),
      ],
      hooks: {
        draw: [events.drawOver],
        setCursor: [
          (self) => {
            const { left = -1 } = self.cursor;
            events.onCursor(left < 0 ? null : self.posToVal(left, "x"));
          },
        ],
        setSelect: [
          (self) => {
            const { left, width } = self.select;
            if (width < 3) return;
            const [from_s, to_s] = [self.posToVal(left, "x"), self.posToVal(left + width, "x")];
            self.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            events.onSelect({ from_s, to_s });
          },
        ],
      },
    },
    [[]],
    root,
  );
  return plot;
}

export function showData(plot: uPlot, drawn: Drawn): void {
  plot.setData([drawn.t_s, ...drawn.values]);
}

function withMargin(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const lacking = Math.max(kLeastRange - (high - low), 0) / 2;
  const margin = (high - low + 2 * lacking) * kMargin;
  return [low - lacking - margin, high + lacking + margin];
}

/** The label of a time isn't cut off by the chart's right edge. */
function fits(plot: uPlot, t_s: number): boolean {
  const right_px = plot.bbox.width / devicePixelRatio + kPaddingRight_px;
  return plot.valToPos(t_s, "x") + kHalfTimeLabel_px <= right_px;
}

function labels(splits: readonly number[], step: number, period: number | undefined): string[] {
  const decimals = step < 1 ? Math.ceil(-Math.log10(step) - 1e-9) : 0;
  return splits.map((value) =>
    period === undefined
      ? fixed(value, decimals)
      : String(Math.round(((value % period) + period) % period)).padStart(3, "0"),
  );
}

import { useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import { identityOf, readColours } from "../map/colours";
import { theme } from "../state/settings";
import { clock, fixed, kNone } from "../units/format";
import { inChosenUnits } from "../units/station_text";
import { chartData } from "./chart_data";
import type { ChartSpec } from "./chart_list";
import { makePlot, showData } from "./chart_plot";
import { cursor_s } from "./charts_state";
import { drawMarks, marksNear, type EventMark } from "./event_marks";
import type { FlightSeries } from "./flight_series";
import { listenForGestures, type Gestures } from "./gestures";
import type { Span } from "./time_window";

interface ChartViewProps {
  chart: ChartSpec;
  series: FlightSeries;
  span: Span;
  marks: readonly EventMark[];
  /** Rises with each redrawing that is due. */
  revision: number;
  gestures: Gestures;
  select: (span: Span) => void;
  /** Plots that are on the screen, for the picture. */
  plots: Map<string, uPlot>;
  /** In a recording: what is played, and how to go elsewhere. */
  playing_s: number | null;
  go: ((t_s: number) => void) | null;
}

/** How near the pointer must be to a mark [px]. */
const kNear_px = 6;
/** A press that moves further is a drag. */
const kStill_px = 3;

export function ChartView(props: ChartViewProps) {
  const { chart, series, span, marks, revision, plots, playing_s } = props;
  const root = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const newest = useRef(props);
  newest.current = props;
  const told = useSignal<{ marks: EventMark[]; left_px: number } | null>(null);
  const ids = series.ids.join();
  const unit = chart.unit();
  const theme_now = theme.value;

  useLayoutEffect(() => {
    const element = root.current;
    if (element === null) return;
    const colours = readColours();
    const now = () => newest.current;
    const made = makePlot(element, chart, now().series.ids, colours, () => now().span, {
      onCursor: (t_s) => {
        cursor_s.value = t_s;
      },
      onSelect: (selected) => {
        now().select(selected);
      },
      drawOver: (self) => {
        drawMarks(self, now().marks, colours);
      },
    });
    plot.current = made;
    plots.set(chart.column, made);
    const deaf = listenForGestures(made.over, {
      zoom: (factor, at) => {
        now().gestures.zoom(factor, at);
      },
      pan: (part) => {
        now().gestures.pan(part);
      },
      reset: () => {
        now().gestures.reset();
      },
    });
    const point = (event: PointerEvent) => {
      const left_px = event.clientX - made.over.getBoundingClientRect().left;
      const within_s = made.posToVal(left_px + kNear_px, "x") - made.posToVal(left_px, "x");
      const near = marksNear(now().marks, made.posToVal(left_px, "x"), within_s);
      told.value = near.length === 0 ? null : { marks: near, left_px: left_px + made.over.offsetLeft };
    };
    const leave = () => {
      told.value = null;
    };
    let pressed_px = NaN;
    const press = (event: PointerEvent) => {
      pressed_px = event.clientX;
    };
    const click = (event: MouseEvent) => {
      if (Math.abs(event.clientX - pressed_px) > kStill_px) return;
      now().go?.(made.posToVal(event.clientX - made.over.getBoundingClientRect().left, "x"));
    };
    made.over.addEventListener("pointerdown", press);
    made.over.addEventListener("click", click);
    made.over.addEventListener("pointermove", point);
    made.over.addEventListener("pointerleave", leave);
    const observer = new ResizeObserver(() => {
      made.setSize({ width: element.clientWidth, height: element.clientHeight });
    });
    observer.observe(element);
    return () => {
      observer.disconnect();
      deaf();
      plots.delete(chart.column);
      made.destroy();
    };
  }, [chart, ids, unit, theme_now, plots, told]);

  useEffect(() => {
    const made = plot.current;
    if (made !== null)
      showData(made, chartData(newest.current.series, chart, newest.current.span, made.over.clientWidth));
  }, [chart, ids, unit, theme_now, revision, series, span.from_s, span.to_s, marks]);

  useEffect(() => {
    const made = plot.current;
    if (made !== null) showPlayed(made, playing_s);
  });

  return (
    <figure class="chart" data-chart={chart.column}>
      <figcaption>
        {chart.title} <small>{unit}</small>
      </figcaption>
      <div class="chart-plot" ref={root} />
      <Values chart={chart} series={series} revision={revision} playing_s={playing_s} />
      {told.value !== null && (
        <div class="chart-tip" style={{ left: `${told.value.left_px}px` }} role="tooltip">
          {told.value.marks.map((mark) => (
            <p key={`${mark.t_s}${mark.text}`}>
              <time>T+ {clock(mark.t_s)}</time> {inChosenUnits(mark.text)}
            </p>
          ))}
        </div>
      )}
    </figure>
  );
}

interface ValuesProps {
  chart: ChartSpec;
  series: FlightSeries;
  revision: number;
  playing_s: number | null;
}

/** The value of each curve at the cursor; without one, the newest, in a recording what is played. */
function Values({ chart, series, playing_s }: ValuesProps) {
  const at_s = cursor_s.value ?? playing_s;
  const at = at_s === null ? series.count - 1 : series.indexAt(at_s);
  return (
    <ul
      class="chart-values"
      aria-label={`${chart.title}, ${cursor_s.value !== null ? "at the cursor" : playing_s === null ? "now" : "as played"}`}
    >
      {series.ids.map((id) => {
        const value = series.values(id, chart.column)?.[at] ?? NaN;
        return (
          <li key={id}>
            <span class={`chip identity-${identityOf(id)}`}>{id}</span>
            <span class="chart-value">{Number.isNaN(value) ? kNone : shown(chart, value)}</span>
          </li>
        );
      })}
    </ul>
  );
}

/** A line at what is played; null: there is none. */
function showPlayed(plot: uPlot, t_s: number | null): void {
  let line = plot.over.querySelector<HTMLElement>(".played");
  if (line === null) {
    line = document.createElement("div");
    line.className = "played";
    plot.over.append(line);
  }
  const left_px = t_s === null ? NaN : plot.valToPos(t_s, "x");
  const seen = left_px >= 0 && left_px <= plot.over.clientWidth;
  line.hidden = !seen;
  if (seen) line.style.transform = `translateX(${left_px}px)`;
}

function shown(chart: ChartSpec, si: number): string {
  const value = chart.value(si);
  return chart.period === undefined
    ? fixed(value, chart.decimals)
    : String(Math.round(value) % chart.period).padStart(3, "0");
}

import { useEffect, useMemo, useRef } from "preact/hooks";
import type uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import "./charts.css";
import { readColours } from "../map/colours";
import type { PanelProps } from "../shell/panel_props";
import { clock, utc } from "../units/format";
import { ChartView } from "./chart_view";
import { kCharts } from "./chart_list";
import { cursor_s, hidden_charts, showFlight, time_window } from "./charts_state";
import { ChartsToolbar } from "./charts_toolbar";
import { toCsv } from "./csv";
import { drawnIds } from "./curves";
import { download, fileName } from "../shell/download";
import { marksOf } from "./event_marks";
import { FlightCurves } from "./flight_curves";
import { drawPicture } from "./png";
import { playedOf } from "./played";
import { kAll, pan, spanOf, zoom, type Span, type TimeWindow } from "./time_window";

/** Live curves are drawn anew so often. */
const kRedraw_ms = 1000;
/** The worst change all the time; their curves stay for a while. */
const kSameFor_ms = 10_000;
const kZoomByKey = 1.5;
const kPanByKey = 0.15;
/** Of the time shown. */
const kCursorByKey = 0.01;

/** The paper's data display: curves of the selected UAVs, or of the worst, since the scenario's start. */
export function ChartsPanel({ station }: PanelProps) {
  const { store } = station;
  const now_ms = store.now_ms.value;
  const roster = store.roster.value;
  const selection = store.selection.value;
  const curves = useRef<FlightCurves | null>(null);
  curves.current ??= new FlightCurves(store, station.api, station.player);
  const plots = useRef(new Map<string, uPlot>()).current;
  const chosen = useRef({ roster, selection, ids: [] as readonly number[], at_ms: -Infinity });
  useEffect(
    () => () => {
      curves.current?.close();
      cursor_s.value = null;
    },
    [],
  );

  if (
    chosen.current.roster !== roster ||
    chosen.current.selection !== selection ||
    now_ms - chosen.current.at_ms > kSameFor_ms
  ) {
    const ids = drawnIds(store.fleet, roster?.vehicles ?? [], selection);
    chosen.current = { roster, selection, ids, at_ms: now_ms };
  }
  curves.current.update(chosen.current.ids, now_ms);
  const { series } = curves.current;
  const loading = curves.current.loading.value;

  const start_utime = roster?.start_utime ?? 0;
  useEffect(() => {
    showFlight(start_utime);
  }, [start_utime]);
  const revision = Math.floor(now_ms / kRedraw_ms);
  const events = store.events.value;
  const wanted_window = time_window.value;
  const playing = playedOf(station, start_utime, now_ms);
  // Once a redrawing, and at once when something else is to be seen: not on every beat.
  const { start_s, now_s, span, marks } = useMemo(() => {
    const start_s = Math.max(series.times()[0] ?? 0, 0);
    const now_s = Math.max(series.last_s(), start_s);
    // In a recording, "the last minute" is the one before what is played.
    const until_s = playing === null || wanted_window === kAll ? now_s : Math.max(playing.t_s, start_s);
    const span = spanOf(wanted_window, start_s, until_s);
    const marks = playing === null ? marksOf(events, start_utime, span) : playing.marks(span);
    return { revision, start_s, now_s, span, marks };
    // What is played moves on with the revision.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [series, revision, events, start_utime, wanted_window, playing === null, station.player.info.value]);
  const charts = kCharts.filter(({ column }) => !hidden_charts.value.includes(column));

  const choose = (window: TimeWindow) => {
    // The end of a recording does not move on.
    const fixed = playing !== null && window !== kAll;
    time_window.value = fixed ? spanOf(window, start_s, now_s) : window;
  };
  const gestures = {
    zoom: (factor: number, at: number) => {
      const at_s = span.from_s + at * (span.to_s - span.from_s);
      choose(zoom(span, factor, at_s, start_s, now_s));
    },
    pan: (part: number) => {
      choose(pan(span, part, start_s, now_s));
    },
    reset: () => {
      time_window.value = kAll;
    },
  };
  const moveCursor = (part: number) => {
    const from_s = cursor_s.value ?? span.to_s;
    const t_s = Math.min(Math.max(from_s + part * (span.to_s - span.from_s), span.from_s), span.to_s);
    // One plot's cursor takes the others along.
    const plot = [...plots.values()][0];
    plot?.setCursor({ left: plot.valToPos(t_s, "x"), top: 0 });
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget || event.ctrlKey || event.metaKey || event.altKey) return;
    const actions: Record<string, () => void> = {
      "+": () => {
        gestures.zoom(1 / kZoomByKey, 0.5);
      },
      "-": () => {
        gestures.zoom(kZoomByKey, 0.5);
      },
      "0": gestures.reset,
      ArrowLeft: () => {
        if (event.shiftKey) moveCursor(-kCursorByKey);
        else gestures.pan(-kPanByKey);
      },
      ArrowRight: () => {
        if (event.shiftKey) moveCursor(kCursorByKey);
        else gestures.pan(kPanByKey);
      },
    };
    const action = actions[event.key];
    if (action === undefined) return;
    event.preventDefault();
    action();
  };

  const exportCsv = () => {
    const text = toCsv(series, charts, span, start_utime, (id) => store.callsign(id));
    download(fileName(start_utime + now_s * 1e6, "csv"), new Blob([text], { type: "text/csv" }));
  };
  const exportPng = () => {
    const style = getComputedStyle(document.documentElement);
    void drawPicture({
      title: roster?.scenario ?? "",
      subtitle: told(span, start_utime),
      charts: charts.flatMap((chart) => {
        const plot = plots.get(chart.column);
        return plot === undefined ? [] : [{ chart, plot }];
      }),
      curves: series.ids.map((id) => ({ id, callsign: store.callsign(id) })),
      colours: readColours(),
      background: style.getPropertyValue("--surface").trim(),
    }).then((picture) => {
      if (picture !== null) download(fileName(start_utime + now_s * 1e6, "png"), picture);
    });
  };

  return (
    <section class="charts-panel" aria-label="Charts">
      <ChartsToolbar
        store={store}
        ids={series.ids}
        empty={series.count === 0 || charts.length === 0}
        exportCsv={exportCsv}
        exportPng={exportPng}
      />
      <div
        class="charts"
        data-keys
        role="group"
        tabIndex={0}
        aria-label="Charts: plus and minus zoom, arrows move, with Shift they move the cursor, 0 shows all"
        onKeyDown={onKey}
      >
        {series.count === 0 ? (
          <p class="empty">
            {loading.kind === "loading"
              ? "Fetching the flight so far…"
              : loading.kind === "failed"
                ? `The flight so far can't be had: ${loading.reason} Trying again.`
                : roster === null
                  ? "No UAV is known yet: curves come with the fleet."
                  : "No sample yet: curves begin with the scenario."}
          </p>
        ) : charts.length === 0 ? (
          <p class="empty">All charts are hidden: choose some under Charts.</p>
        ) : (
          charts.map((chart) => (
            <ChartView
              key={chart.column}
              chart={chart}
              series={series}
              span={span}
              marks={marks}
              revision={revision}
              gestures={gestures}
              select={(selected) => {
                time_window.value = selected;
              }}
              plots={plots}
              playing_s={playing?.t_s ?? null}
              go={playing?.go ?? null}
            />
          ))
        )}
      </div>
    </section>
  );
}

function told({ from_s, to_s }: Span, start_utime: number): string {
  const date = new Date(start_utime / 1000).toISOString().slice(0, 10);
  const at = (t_s: number) => `T+ ${clock(t_s)} (${utc(start_utime + t_s * 1e6)})`;
  return `${date}, ${at(from_s)} to ${at(to_s)} UTC`;
}

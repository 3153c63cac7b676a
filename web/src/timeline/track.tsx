import { useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { kAll, pan, spanOf, zoom, type TimeWindow } from "../charts/time_window";
import type { Damage, Mark, RecordingInfo } from "../link/recording_messages";
import { readColours } from "../map/colours";
import { Lamp } from "../panels/icons";
import type { Station } from "../shell/station";
import { theme } from "../state/settings";
import { useWidth } from "../table/use_width";
import { utc } from "../units/format";
import { size } from "../units/size";
import { inChosenUnits } from "../units/station_text";
import { drawTrack, kTrackHeight_px } from "./draw_track";
import { markName, marksAt } from "./marks";
import type { Player } from "./player";
import { secondsPerPixel, spanWith, timeOf, xOf, type Scale } from "./scale";
import { clockTenths, spoken } from "./time_text";
import { listenToTrack } from "./track_gestures";
import { useFrameTime } from "./use_frame_time";

interface Props {
  station: Station;
  disabled: boolean;
}

const kArrow_s = 5;
const kPage_s = 60;
const kZoomByKey = 1.5;

/** The line itself: a slider over the whole recording, or over the part that is zoomed in on. */
export function Track({ station, disabled }: Props) {
  const { player, store } = station;
  const root = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const width_px = useWidth(root);
  const shown = useSignal<TimeWindow>(kAll);
  const pointed_px = useSignal<number | null>(null);

  const duration_s = player.duration_s();
  const info = player.info.value;
  const loop = store.playback.value?.loop ?? null;
  void store.now_ms.value;
  const at_s = player.at_s(performance.now());
  const whole = shown.value === kAll;
  const wanted = spanOf(shown.value, 0, duration_s);
  const span = whole || player.wanted_s.value !== null ? wanted : spanWith(wanted, at_s, duration_s);
  const scale: Scale = { ...span, width_px: Math.max(width_px, 1) };
  const [a_s, b_s] = [loop?.[0] ?? player.loop_a_s.value, loop?.[1] ?? null];

  const change = (next: TimeWindow) => {
    // "The newest part" means nothing in a recording: it ends where it ends.
    const next_span = spanOf(next, 0, duration_s);
    shown.value = next_span.from_s <= 0 && next_span.to_s >= duration_s ? kAll : next_span;
  };
  const zoomAt = (factor: number, at: number) => {
    change(zoom(span, factor, at, 0, duration_s));
  };
  const gestures = useRef({ scrub, point, zoom: zoomTo, pan: panBy });
  function scrub(x_px: number) {
    if (!disabled) player.seek(timeOf(scale, x_px));
  }
  function point(x_px: number | null) {
    pointed_px.value = x_px === null ? null : Math.min(Math.max(x_px, 0), width_px);
  }
  function zoomTo(factor: number, at_px: number) {
    zoomAt(factor, timeOf(scale, at_px));
  }
  function panBy(by_px: number) {
    change(pan(span, by_px / scale.width_px, 0, duration_s));
  }
  gestures.current = { scrub, point, zoom: zoomTo, pan: panBy };
  useEffect(
    () => (root.current === null ? undefined : listenToTrack(root.current, () => gestures.current)),
    [],
  );

  const theme_now = theme.value;
  useLayoutEffect(() => {
    const element = canvas.current;
    const context = element?.getContext("2d");
    if (!element || !context || width_px === 0) return;
    element.width = Math.round(width_px * devicePixelRatio);
    element.height = Math.round(kTrackHeight_px * devicePixelRatio);
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    drawTrack(context, {
      info,
      scale: { from_s: span.from_s, to_s: span.to_s, width_px },
      duration_s,
      loop: a_s === null ? null : { from_s: a_s, to_s: b_s ?? a_s },
      colours: readColours(),
    });
  }, [info, span.from_s, span.to_s, width_px, duration_s, a_s, b_s, theme_now]);

  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const to = (t_s: number) => () => {
      player.seek(t_s);
    };
    const now_s = player.at_s(performance.now());
    const arrow_s = event.shiftKey ? kPage_s : kArrow_s;
    const actions: Record<string, () => void> = {
      ArrowRight: to(now_s + arrow_s),
      ArrowUp: to(now_s + arrow_s),
      ArrowLeft: to(now_s - arrow_s),
      ArrowDown: to(now_s - arrow_s),
      PageUp: to(now_s + kPage_s),
      PageDown: to(now_s - kPage_s),
      Home: to(0),
      End: to(duration_s),
      "+": () => {
        zoomAt(1 / kZoomByKey, now_s);
      },
      "-": () => {
        zoomAt(kZoomByKey, now_s);
      },
      "0": () => {
        shown.value = kAll;
      },
    };
    const action = actions[event.key];
    if (action === undefined || disabled) return;
    event.preventDefault();
    action();
  };

  return (
    <div class="track-row">
      <div
        class="track"
        ref={root}
        role="slider"
        tabIndex={0}
        aria-label="Time in the recording: arrows 5 seconds, Page Up and Page Down a minute, plus and minus zoom, 0 shows all"
        aria-disabled={disabled}
        aria-busy={player.busy()}
        aria-valuemin={0}
        aria-valuemax={Math.round(duration_s * 10) / 10}
        aria-valuenow={Math.round(at_s * 10) / 10}
        aria-valuetext={`${spoken(at_s)} of ${spoken(duration_s)}`}
        style={{ height: `${kTrackHeight_px}px` }}
        onKeyDown={press}
      >
        <canvas ref={canvas} aria-hidden="true" />
        {!disabled && <Playhead player={player} scale={scale} />}
        {pointed_px.value !== null && duration_s > 0 && (
          <div class="pointed" style={{ transform: `translateX(${pointed_px.value}px)` }} />
        )}
      </div>
      {pointed_px.value !== null && duration_s > 0 && (
        <Pointed player={player} info={info} scale={scale} x_px={pointed_px.value} />
      )}
      {!whole && (
        <button
          type="button"
          class="button track-whole"
          title="The whole recording (0 on the line)"
          onClick={() => {
            shown.value = kAll;
          }}
        >
          Whole recording
        </button>
      )}
    </div>
  );
}

function Playhead({ player, scale }: { player: Player; scale: Scale }) {
  const x_px = xOf(scale, useFrameTime(player));
  if (x_px < -1 || x_px > scale.width_px + 1) return null;
  return <div class="playhead" style={{ transform: `translateX(${x_px}px)` }} />;
}

interface PointedProps {
  player: Player;
  info: RecordingInfo | null;
  scale: Scale;
  x_px: number;
}

const kNear_px = 5;
const kMostTold = 4;
/** Of the section around the line. */
const kPadding_px = 12;

/** What is where the pointer is. */
function Pointed({ player, info, scale, x_px }: PointedProps) {
  const t_s = timeOf(scale, x_px);
  const within_s = kNear_px * secondsPerPixel(scale);
  const { told, more } = marksAt(info?.marks ?? [], t_s, within_s, kMostTold);
  const torn = (info?.damage ?? []).find((one) => Math.abs(one.t_s - t_s) <= within_s);
  const start_utime = player.start_utime();
  // Towards the middle, so that it stays on the page.
  const side = x_px < scale.width_px / 2 ? "" : " leftwards";
  return (
    <div class={`track-tip panel${side}`} style={{ left: `${x_px + kPadding_px}px` }} role="tooltip">
      <p class="track-tip-time">
        {clockTenths(t_s)} {start_utime !== null && <span>{utc(start_utime + t_s * 1e6)} UTC</span>}
      </p>
      {told.map((mark, i) => (
        <MarkLine key={i} mark={mark} />
      ))}
      {more > 0 && <p class="hint">and {more} more</p>}
      {torn !== undefined && <p>{tornText(torn)}</p>}
    </div>
  );
}

function MarkLine({ mark }: { mark: Mark }) {
  return (
    <p title={markName(mark)}>
      {mark.kind === "marker" ? <span class="marker-flag">⚑</span> : <Lamp level={mark.severity} />}{" "}
      <time>{clockTenths(mark.t_s)}</time> {inChosenUnits(mark.text)}
    </p>
  );
}

function tornText({ bytes, reason }: Damage): string {
  return `Unreadable, ${size(bytes)}: ${reason}`;
}

import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { niceStep } from "../units/nice_step";
import { altitude, distance, kAltitudeReference } from "../units/quantities";
import type { PathDraft } from "./path_draft";
import { kAltitudeRange_m } from "./path_plan";
import type { Planner } from "./planner";
import { profileOf, type Profile } from "./profile";

const kHeight_px = 142;
/** The first waypoint does not lie on the numbers of the axis. */
const kInset_px = 10;
const kMargin_px = { left: 46, right: 24, top: 26, bottom: 20 };
const kLeastSpan_m = 200;
/** A drag gives round numbers. */
const kDragStep_m = 10;

interface ProfileChartProps {
  planner: Planner;
  draft: PathDraft;
}

/** Altitude along the path; waypoints can be dragged up and down. By keyboard their altitudes are in the table. */
export function ProfileChart({ planner, draft }: ProfileChartProps) {
  const svg = useRef<SVGSVGElement>(null);
  const width_px = useSignal(340);
  /** The scale stands still while somebody drags. */
  const held = useSignal<{ index: number; scale: Scale } | null>(null);
  useLayoutEffect(() => {
    const seen = new ResizeObserver(([entry]) => {
      if (entry !== undefined) width_px.value = entry.contentRect.width;
    });
    if (svg.current !== null) seen.observe(svg.current);
    return () => {
      seen.disconnect();
    };
  }, [width_px]);

  const plan = draft.plan.value;
  const geometry = planner.preview.geometry.value;
  const line = geometry?.plan === plan && geometry.preview.ok ? geometry.preview.line : [];
  const profile = profileOf(plan, planner.legs.value, line);
  const scale = held.value?.scale ?? scaleOf(profile, width_px.value);
  const problems = new Set(planner.problems.value.map(({ waypoint_index }) => waypoint_index));

  const drag = (event: PointerEvent) => {
    const box = svg.current?.getBoundingClientRect();
    if (held.value === null || box === undefined) return;
    const step = altitude.toSi(kDragStep_m);
    const up_m = Math.round(scale.upAt(event.clientY - box.top) / step) * step;
    const { least, most } = kAltitudeRange_m;
    const { index } = held.value;
    draft.set(index, { up_m: Math.min(Math.max(up_m, least), most) }, "altitude", `profile ${index}`);
  };
  return (
    <svg
      ref={svg}
      class="profile"
      height={kHeight_px}
      role="img"
      aria-label={`Altitude along the path, ${altitude.unit()} ${kAltitudeReference} over ${distance.unit()}`}
      onPointerMove={drag}
      // However it ends: let go, or taken away by a menu or a second finger.
      onLostPointerCapture={() => {
        held.value = null;
        draft.history.endGesture();
      }}
    >
      {ticks(scale.low_m, scale.high_m, altitude).map((up_m) => (
        <g key={up_m} class="profile-grid">
          <path d={`M${kMargin_px.left} ${scale.y(up_m)}H${width_px.value - kMargin_px.right}`} />
          <text x={kMargin_px.left - 6} y={scale.y(up_m) + 4} text-anchor="end">
            {altitude.text(up_m)}
          </text>
        </g>
      ))}
      <text class="profile-along" x={2} y={11}>
        {`${altitude.unit()} ${kAltitudeReference}`}
      </text>
      {ticks(0, scale.length_m, distance).map((along_m, i, all) => (
        <text
          key={along_m}
          class="profile-along"
          x={scale.x(along_m)}
          y={kHeight_px - 5}
          text-anchor="middle"
        >
          {i === all.length - 1 ? distance.full(along_m) : distance.text(along_m)}
        </text>
      ))}
      <path
        class="profile-line"
        d={`M${profile.line.map(({ along_m, up_m }) => `${scale.x(along_m).toFixed(1)} ${scale.y(up_m).toFixed(1)}`).join("L")}`}
      />
      {profile.waypoints.map(({ along_m, up_m }, i) => (
        <g
          key={i}
          class={`profile-waypoint${draft.selected.value === i ? " selected" : ""}${problems.has(i) ? " problem" : ""}`}
          transform={`translate(${scale.x(along_m)} ${scale.y(up_m)})`}
          onPointerDown={(event) => {
            if (event.button !== 0) return;
            event.preventDefault();
            // What is typed in a field belongs to the waypoint that was selected until now.
            if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
            svg.current?.setPointerCapture(event.pointerId);
            draft.selected.value = i;
            held.value = { index: i, scale };
          }}
        >
          <title>{`Waypoint ${i + 1}: drag up or down`}</title>
          <circle class="grip" r="16" />
          <circle r="5" />
          <text y="-9" text-anchor="middle">
            {i + 1}
          </text>
        </g>
      ))}
    </svg>
  );
}

interface Scale {
  low_m: number;
  high_m: number;
  length_m: number;
  x: (along_m: number) => number;
  y: (up_m: number) => number;
  upAt: (y_px: number) => number;
}

function scaleOf({ line, waypoints }: Profile, width_px: number): Scale {
  const ups = [...line, ...waypoints].map(({ up_m }) => up_m);
  const middle_m = (Math.min(...ups) + Math.max(...ups)) / 2;
  const span_m = Math.max((Math.max(...ups) - Math.min(...ups)) * 1.25, kLeastSpan_m);
  const [low_m, high_m] = [middle_m - span_m / 2, middle_m + span_m / 2];
  const length_m = Math.max(line.at(-1)?.along_m ?? 0, 1);
  const [left, right] = [kMargin_px.left + kInset_px, width_px - kMargin_px.right];
  const [top, bottom] = [kMargin_px.top, kHeight_px - kMargin_px.bottom];
  return {
    low_m,
    high_m,
    length_m,
    x: (along_m) => left + ((right - left) * along_m) / length_m,
    y: (up_m) => bottom - ((bottom - top) * (up_m - low_m)) / span_m,
    upAt: (y_px) => low_m + (span_m * (bottom - y_px)) / (bottom - top),
  };
}

/** Round numbers of the unit that is shown, in SI. */
function ticks(
  low: number,
  high: number,
  quantity: { value(si: number): number; toSi(value: number): number },
): number[] {
  const [from, to] = [quantity.value(low), quantity.value(high)];
  const step = niceStep((to - from) / 4);
  const first = Math.ceil(from / step);
  const count = Math.max(Math.floor(to / step) - first + 1, 0);
  return Array.from({ length: count }, (_, i) => quantity.toSi((first + i) * step));
}

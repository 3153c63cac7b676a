/** What the time line looks like: how much happened when, marks, the loop, what is missing. */
import { severityShape } from "../charts/event_marks";
import type { Colours } from "../map/colours";
import type { Damage, Mark, RecordingInfo } from "../link/recording_messages";
import { groupMarks, isLandmark } from "./marks";
import type { Span } from "./playing";
import { ticks, xOf, type Scale } from "./scale";
import { tickLabel } from "./time_text";

export const kTrackHeight_px = 58;
/** From top to bottom: marks, bars, labels. */
const kMarks_px = 18;
const kBase_px = 42;
const kMark_px = 4.5;
const kMarksApart_px = 7;
const kFont = '10.5px "Inter Variable", system-ui, sans-serif';

export interface TrackPicture {
  info: RecordingInfo | null;
  scale: Scale;
  duration_s: number;
  loop: Span | null;
  colours: Colours;
}

export function drawTrack(context: CanvasRenderingContext2D, picture: TrackPicture): void {
  const { info, scale, loop, colours } = picture;
  context.clearRect(0, 0, scale.width_px, kTrackHeight_px);
  drawTicks(context, picture);
  if (loop !== null) drawLoop(context, scale, loop, colours);
  if (info !== null) {
    for (const { t_s } of info.flights.slice(1)) drawFlight(context, xOf(scale, t_s), colours);
    drawDensity(context, info, scale, colours);
    drawDamage(context, info.damage, scale, colours);
    drawMarks(context, info.marks, scale, colours);
  }
  context.globalAlpha = 1;
}

function drawTicks(context: CanvasRenderingContext2D, { scale, duration_s, colours }: TrackPicture): void {
  context.strokeStyle = colours.map_axis;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(0, kBase_px + 0.5);
  context.lineTo(scale.width_px, kBase_px + 0.5);
  context.font = kFont;
  context.fillStyle = colours.muted;
  context.textBaseline = "top";
  for (const t_s of ticks(scale)) {
    const x = Math.round(xOf(scale, t_s)) + 0.5;
    context.moveTo(x, kBase_px);
    context.lineTo(x, kBase_px + 4);
    const text = tickLabel(t_s, duration_s);
    const { width } = context.measureText(text);
    context.fillText(text, Math.min(Math.max(x - width / 2, 0), scale.width_px - width), kBase_px + 5);
  }
  context.stroke();
}

/** Muted: all events; over it those of severity 2 and 3. Heights by the root, so that one event is seen beside a hundred. */
function drawDensity(
  context: CanvasRenderingContext2D,
  { density: { bin_s, events, warnings } }: RecordingInfo,
  scale: Scale,
  colours: Colours,
): void {
  const most = Math.max(1, ...events);
  const tall_px = kBase_px - kMarks_px - 2;
  const bars = (counts: readonly number[], colour: string, alpha: number) => {
    context.fillStyle = colour;
    context.globalAlpha = alpha;
    counts.forEach((count, bin) => {
      const x = xOf(scale, bin * bin_s);
      const width = xOf(scale, (bin + 1) * bin_s) - x;
      if (count === 0 || x + width < 0 || x > scale.width_px) return;
      const height = Math.max(2, tall_px * Math.sqrt(count / most));
      context.fillRect(x, kBase_px - height, Math.max(1, width - (width > 3 ? 1 : 0)), height);
    });
    context.globalAlpha = 1;
  };
  bars(events, colours.muted, 0.5);
  bars(warnings, colours.level[2], 0.9);
}

function drawLoop(context: CanvasRenderingContext2D, scale: Scale, loop: Span, colours: Colours): void {
  const [a, b] = [xOf(scale, loop.from_s), xOf(scale, loop.to_s)];
  context.fillStyle = colours.accent;
  context.globalAlpha = 0.18;
  context.fillRect(a, 0, b - a, kBase_px);
  context.globalAlpha = 1;
  context.fillRect(a - 1, 0, 2, kBase_px);
  context.fillRect(b - 1, 0, 2, kBase_px);
  context.font = `600 ${kFont}`;
  context.textBaseline = "top";
  context.fillText("A", a + 4, kMarks_px + 1);
  context.fillText("B", b - 11, kMarks_px + 1);
}

/** Another start of the scenario. */
function drawFlight(context: CanvasRenderingContext2D, x: number, colours: Colours): void {
  context.strokeStyle = colours.text;
  context.globalAlpha = 0.6;
  context.setLineDash([2, 3]);
  context.beginPath();
  context.moveTo(Math.round(x) + 0.5, 0);
  context.lineTo(Math.round(x) + 0.5, kBase_px);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

const kDamage_px = 7;

/** A torn edge below the base line. */
function drawDamage(
  context: CanvasRenderingContext2D,
  damage: readonly Damage[],
  scale: Scale,
  colours: Colours,
): void {
  context.strokeStyle = colours.text;
  context.lineWidth = 1.5;
  for (const { t_s } of damage) {
    const x = xOf(scale, t_s);
    context.beginPath();
    context.moveTo(x - kDamage_px, kBase_px);
    for (let i = 1; i <= 4; i += 1)
      context.lineTo(x - kDamage_px + (i * kDamage_px) / 2, kBase_px + (i % 2 === 1 ? -4 : 4));
    context.stroke();
  }
}

function drawMarks(
  context: CanvasRenderingContext2D,
  marks: readonly Mark[],
  scale: Scale,
  colours: Colours,
): void {
  const seen = marks.filter(({ t_s }) => t_s >= scale.from_s && t_s <= scale.to_s);
  const x_of = (t_s: number) => xOf(scale, t_s);
  // What can be jumped to lies over the other events, and is never hidden in a group of them.
  drawGroups(
    context,
    groupMarks(
      seen.filter((mark) => !isLandmark(mark)),
      x_of,
      3,
    ),
    colours,
  );
  drawGroups(context, groupMarks(seen.filter(isLandmark), x_of, kMarksApart_px), colours);
}

function drawGroups(
  context: CanvasRenderingContext2D,
  groups: ReturnType<typeof groupMarks>,
  colours: Colours,
): void {
  for (const { x_px, shown } of groups) {
    const landmark = isLandmark(shown);
    const colour = shown.kind === "marker" ? colours.accent : colours.level[shown.severity as 0 | 1 | 2 | 3];
    context.fillStyle = colour;
    context.strokeStyle = colour;
    context.globalAlpha = landmark ? 1 : 0.55;
    context.beginPath();
    if (shown.kind === "marker") flag(context, x_px);
    else if (landmark) severityShape(context, shown.severity, x_px, kMarks_px / 2, kMark_px);
    else context.rect(Math.round(x_px), kMarks_px - 5, 1, 5);
    context.fill();
  }
}

function flag(context: CanvasRenderingContext2D, x: number): void {
  context.rect(x - 0.75, 2, 1.5, kMarks_px - 2);
  context.moveTo(x, 2);
  context.lineTo(x + 9, 5.5);
  context.lineTo(x, 9);
}

/** Events as vertical marks on a chart, with the shape and colour of their severity. */
import type uPlot from "uplot";
import type { BusEvent } from "../link/messages";
import type { Colours } from "../map/colours";
import type { Span } from "./time_window";

export interface EventMark {
  t_s: number;
  severity: number;
  text: string;
}

/** Those within `span`, oldest first, so that the newest is drawn on top. */
export function marksOf(events: readonly BusEvent[], start_utime: number, span: Span): EventMark[] {
  return events
    .map(({ utime, severity, text }) => ({ t_s: (utime - start_utime) / 1e6, severity, text }))
    .filter(({ t_s }) => t_s >= span.from_s && t_s <= span.to_s)
    .sort((a, b) => a.t_s - b.t_s);
}

/** Those that the pointer is at. */
export function marksNear(marks: readonly EventMark[], t_s: number, within_s: number): EventMark[] {
  return marks.filter((mark) => Math.abs(mark.t_s - t_s) <= within_s);
}

const kMark_px = 3.5;

export function drawMarks(plot: uPlot, marks: readonly EventMark[], colours: Colours): void {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  ctx.save();
  for (const { t_s, severity } of marks) {
    const x = plot.valToPos(t_s, "x", true);
    const colour = colours.level[severity as 0 | 1 | 2 | 3];
    ctx.strokeStyle = colour;
    ctx.fillStyle = colour;
    ctx.globalAlpha = severity > 0 ? 0.9 : 0.45;
    ctx.lineWidth = ratio;
    ctx.setLineDash([3 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.setLineDash([]);
    ctx.beginPath();
    severityShape(ctx, severity, x, bbox.top, kMark_px * ratio);
    ctx.fill();
  }
  ctx.restore();
}

/** Square, disc and diamond, as everywhere; a tick for what is no alert. */
export function severityShape(
  ctx: CanvasRenderingContext2D,
  severity: number,
  x: number,
  y: number,
  size: number,
): void {
  if (severity === 3) ctx.rect(x - size, y - size, 2 * size, 2 * size);
  else if (severity === 2) ctx.arc(x, y, size, 0, 2 * Math.PI);
  else if (severity === 1) {
    ctx.moveTo(x, y - size * 1.3);
    ctx.lineTo(x + size * 1.3, y);
    ctx.lineTo(x, y + size * 1.3);
    ctx.lineTo(x - size * 1.3, y);
  } else ctx.rect(x - size / 3, y - size, (size * 2) / 3, size);
}

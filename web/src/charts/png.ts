/** All charts that are shown, as one picture with title and legend. */
import type uPlot from "uplot";
import { identityOf, type Colours } from "../map/colours";
import type { ChartSpec } from "./chart_list";
import { dashOf } from "./curves";

export interface Picture {
  title: string;
  /** Which time it shows. */
  subtitle: string;
  charts: readonly { chart: ChartSpec; plot: uPlot }[];
  curves: readonly { id: number; callsign: string }[];
  colours: Colours;
  background: string;
}

const kColumns = 2;
const kGap = 16;
const kHead = 58;
const kTitle = 20;

export function drawPicture({
  title,
  subtitle,
  charts,
  curves,
  colours,
  background,
}: Picture): Promise<Blob | null> {
  const ratio = devicePixelRatio;
  const canvas = document.createElement("canvas");
  const width = Math.max(...charts.map(({ plot }) => plot.ctx.canvas.width), 300 * ratio);
  const height = Math.max(...charts.map(({ plot }) => plot.ctx.canvas.height), 100 * ratio) + kTitle * ratio;
  const columns = Math.min(kColumns, charts.length);
  const gap = kGap * ratio;
  canvas.width = columns * (width + gap) + gap;
  canvas.height = kHead * ratio + Math.ceil(charts.length / columns) * (height + gap) + gap;
  const ctx = canvas.getContext("2d");
  if (ctx === null) return Promise.resolve(null);
  const text = (words: string, x: number, y: number, size: number, weight: number, colour: string) => {
    ctx.fillStyle = colour;
    ctx.font = `${weight} ${size * ratio}px "Inter Variable", system-ui, sans-serif`;
    ctx.fillText(words, x, y);
    return ctx.measureText(words).width;
  };
  ctx.fillStyle = background;
  ctx.fillRect(0, 0, canvas.width, canvas.height);
  ctx.textBaseline = "alphabetic";
  const title_width = text(title, gap, 24 * ratio, 15, 650, colours.text);
  text(subtitle, 2 * gap + title_width, 24 * ratio, 12, 400, colours.muted);

  let x = gap;
  for (const { id, callsign } of curves) {
    const y = 44 * ratio;
    ctx.strokeStyle = colours.identity[identityOf(id) - 1] ?? colours.text;
    ctx.lineWidth = 2 * ratio;
    ctx.setLineDash(dashOf(id).map((part) => part * ratio));
    ctx.beginPath();
    ctx.moveTo(x, y - 4 * ratio);
    ctx.lineTo(x + 26 * ratio, y - 4 * ratio);
    ctx.stroke();
    x += 32 * ratio;
    x += text(callsign, x, y, 12, 500, colours.text) + 18 * ratio;
  }
  ctx.setLineDash([]);

  charts.forEach(({ chart, plot }, i) => {
    const left = gap + (i % columns) * (width + gap);
    const top = kHead * ratio + gap + Math.floor(i / columns) * (height + gap);
    text(`${chart.title}, ${chart.unit()}`, left, top + 12 * ratio, 12, 600, colours.text);
    ctx.drawImage(plot.ctx.canvas, left, top + kTitle * ratio);
  });
  return new Promise((resolve) => {
    canvas.toBlob(resolve, "image/png");
  });
}

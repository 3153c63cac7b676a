/** What moves slowly: grid, paths with their waypoints, trails. Drawn again when the map moves, and twice a second. */
import type { Map as LeafletMap } from "leaflet";
import type { Path } from "../link/messages";
import type { Store } from "../state/store";
import { fixed } from "../units/format";
import type { LocalFrame } from "../units/geodesy";
import { identityOf, type Colours } from "./colours";
import { drawGrid } from "./grid";
import { Overlay } from "./overlay";
import { at, kWaypoint } from "./shapes";
import type { Trails } from "./trails";
import { mercatorLine, pixelOf, pixelsPerMetre, viewOf, xOf, yOf, type View } from "./view";

/** Waypoints say altitude and speed from this scale on [px/m]. */
const kWaypointText_px_per_m = 0.012;

export class GroundLayer {
  private readonly overlay: Overlay;
  private readonly lines = new WeakMap<Path, { frame: LocalFrame; line: Float64Array }>();

  constructor(
    private readonly map: LeafletMap,
    private readonly store: Store,
    private readonly trails: Trails,
  ) {
    this.overlay = new Overlay(map, "ground");
  }

  remove(): void {
    this.overlay.remove();
  }

  draw(frame: LocalFrame | null, colours: Colours): void {
    const context = this.overlay.begin();
    const view = viewOf(this.map);
    drawGrid(context, view, frame, colours);
    if (frame === null) return;
    for (const path of this.store.paths.peek().values()) this.drawPath(context, view, path, frame, colours);
    this.trails.draw(context, view, (id) => colours.identity[identityOf(id) - 1] ?? colours.text);
  }

  private drawPath(
    context: CanvasRenderingContext2D,
    view: View,
    path: Path,
    frame: LocalFrame,
    colours: Colours,
  ): void {
    const line = this.lineOf(path, frame);
    context.strokeStyle = colours.path;
    context.lineWidth = 1.5;
    context.setLineDash([7, 5]);
    context.beginPath();
    for (let i = 0; i < line.length; i += 2) context.lineTo(xOf(view, line[i]), yOf(view, line[i + 1]));
    context.stroke();
    context.setLineDash([]);

    const with_text = pixelsPerMetre(view, frame.origin.latitude_deg) > kWaypointText_px_per_m;
    context.font = "11px 'Inter Variable', sans-serif";
    path.waypoints.forEach((waypoint, i) => {
      const { x, y } = pixelOf(view, frame, waypoint.east_m, waypoint.north_m, waypoint.up_m);
      context.fillStyle = colours.path;
      at(context, x, y, 0, () => {
        context.fill(kWaypoint);
      });
      if (!with_text) return;
      context.fillStyle = colours.map_text;
      const what = `${fixed(waypoint.up_m)} m ENU  ${fixed(waypoint.speed_m_s)} m/s`;
      context.fillText(`WP${i + 1}`, x + 9, y - 3);
      context.fillText(what, x + 9, y + 10);
    });
  }

  private lineOf(path: Path, frame: LocalFrame): Float64Array {
    const known = this.lines.get(path);
    if (known?.frame === frame) return known.line;
    const line = mercatorLine(frame, path.line);
    this.lines.set(path, { frame, line });
    return line;
  }
}

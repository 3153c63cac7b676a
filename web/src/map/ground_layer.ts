/** What moves slowly: grid, paths with their waypoints, trails. Drawn again when the map moves, and twice a second. */
import type { Map as LeafletMap } from "leaflet";
import type { Path } from "../link/messages";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { identityOf, type Colours } from "./colours";
import { hasTrail } from "./fleet_layer";
import { drawGrid } from "./grid";
import { layers, trail_min, trails_of } from "./layers";
import { Overlay } from "./overlay";
import { kWaypoint } from "./shapes";
import type { Trails } from "./trails";
import { mercatorLine, pixelOf, xOf, yOf, type View } from "./view";

export class GroundLayer {
  private readonly overlay: Overlay;
  private readonly lines = new WeakMap<Path, { frame: LocalFrame; line: Float64Array }>();

  constructor(
    map: LeafletMap,
    private readonly store: Store,
    private readonly trails: Trails,
  ) {
    this.overlay = new Overlay(map, "ground");
  }

  remove(): void {
    this.overlay.remove();
  }

  align(view: View): void {
    this.overlay.align(view);
  }

  draw(view: View, frame: LocalFrame | null, colours: Colours): void {
    const context = this.overlay.begin(view);
    if (layers.grid.shown.peek()) drawGrid(context, view, frame, colours);
    if (frame === null) return;
    if (layers.paths.shown.peek()) {
      for (const path of this.store.paths.peek().values()) this.drawPath(context, view, path, frame, colours);
    }
    const ids = this.store.fleet.motion?.id ?? [];
    const selection = this.store.selection.peek();
    const shown =
      trails_of.peek() === "all" ? ids : ids.filter((id) => hasTrail({ selected: selection.has(id) }));
    this.trails.draw(
      context,
      view,
      { ids: shown, length_min: trail_min.peek() },
      identityOf,
      colours.identity,
    );
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

    context.fillStyle = colours.path;
    if (path.formation_id === this.store.planned_id.peek()) return;
    for (const waypoint of path.waypoints) {
      const { x, y } = pixelOf(view, frame, waypoint.east_m, waypoint.north_m, waypoint.up_m);
      context.translate(x, y);
      context.fill(kWaypoint);
      context.translate(-x, -y);
    }
  }

  private lineOf(path: Path, frame: LocalFrame): Float64Array {
    const known = this.lines.get(path);
    if (known?.frame === frame) return known.line;
    const line = mercatorLine(frame, path.line);
    this.lines.set(path, { frame, line });
    return line;
  }
}

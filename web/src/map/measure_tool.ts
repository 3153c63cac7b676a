/** Measures on the map: a line of several legs, with the length and bearing of each and of the whole. */
import L from "leaflet";
import { effect, signal } from "@preact/signals";
import { compassOf } from "../units/format";
import { farDistance } from "../units/quantities";
import { legBetween } from "./legs";
import type { MapAccess } from "./map_access";

export class MeasureTool {
  readonly active = signal(false);
  private readonly points = signal<readonly L.LatLng[]>([]);
  private readonly drawing = L.layerGroup();
  /** Lines of its own, which the stylesheet can colour. */
  private readonly renderer = L.svg();
  private release: (() => void) | null = null;
  private readonly stopDrawing: () => void;

  constructor(
    private readonly access: MapAccess,
    private readonly middle: () => L.LatLng,
  ) {
    // Units may change while it is shown.
    this.stopDrawing = effect(() => {
      this.draw(this.points.value);
    });
  }

  remove(): void {
    this.stop();
    this.stopDrawing();
  }

  toggle(): void {
    if (this.active.peek()) this.stop();
    else this.start();
  }

  /** Adds the middle of the map: for those who measure without a mouse. */
  addMiddle(): void {
    if (this.active.peek()) this.add(this.middle());
  }

  takeBack(): void {
    this.points.value = this.points.peek().slice(0, -1);
  }

  private start(): void {
    const { leaflet } = this.access;
    this.release = this.access.claim({
      cursor: "crosshair",
      onLost: () => {
        this.stop();
      },
    });
    this.active.value = true;
    this.drawing.addTo(leaflet);
    leaflet.doubleClickZoom.disable();
    leaflet.on("click", this.onClick);
  }

  private stop(): void {
    if (!this.active.peek()) return;
    const { leaflet } = this.access;
    this.active.value = false;
    this.points.value = [];
    leaflet.off("click", this.onClick);
    leaflet.doubleClickZoom.enable();
    this.drawing.remove();
    this.release?.();
    this.release = null;
  }

  private readonly onClick = (event: L.LeafletMouseEvent) => {
    this.add(event.latlng);
  };

  private add(at: L.LatLng): void {
    this.points.value = [...this.points.peek(), at];
  }

  private draw(points: readonly L.LatLng[]): void {
    const { renderer } = this;
    this.drawing.clearLayers();
    if (points.length === 0) return;
    const line = L.polyline([...points], { className: "measure-line", interactive: false, renderer });
    this.drawing.addLayer(line);
    let total_m = 0;
    points.forEach((point, i) => {
      const mark = L.circleMarker(point, {
        radius: 4,
        className: "measure-point",
        interactive: false,
        renderer,
      });
      this.drawing.addLayer(mark);
      const before = points[i - 1];
      if (before === undefined) return;
      const leg = legBetween(placeOf(before), placeOf(point));
      total_m += leg.length_m;
      const sum = i > 1 ? ` (${farDistance(total_m)} in all)` : "";
      const text = `${farDistance(leg.length_m)}, ${compassOf(leg.bearing_rad)}°${sum}`;
      mark.bindTooltip(text, {
        permanent: true,
        direction: "right",
        offset: [8, 0],
        className: "measure-note",
      });
    });
  }
}

function placeOf(at: L.LatLng) {
  return { latitude_deg: at.lat, longitude_deg: at.lng };
}

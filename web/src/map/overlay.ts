import type { Map as LeafletMap } from "leaflet";
import type { View } from "./view";

/** A canvas over the whole map, in pixels of the map's container. It lets the mouse through. */
export class Overlay {
  private readonly canvas = document.createElement("canvas");
  private readonly context: CanvasRenderingContext2D;
  /** As last drawn. */
  private drawn: View | null = null;

  constructor(map: LeafletMap, class_name: string) {
    const context = this.canvas.getContext("2d");
    if (context === null) throw new Error("This browser has no canvas");
    this.context = context;
    this.canvas.className = `overlay ${class_name}`;
    this.canvas.setAttribute("aria-hidden", "true");
    map.getContainer().append(this.canvas);
  }

  remove(): void {
    this.canvas.remove();
  }

  /** The context, cleared, one unit a CSS pixel, for drawing this view. */
  begin(view: View): CanvasRenderingContext2D {
    const ratio = window.devicePixelRatio;
    const width = Math.round(view.width_px * ratio);
    const height = Math.round(view.height_px * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, view.width_px, view.height_px);
    this.drawn = view;
    this.canvas.style.transform = "none";
    return this.context;
  }

  /** Moves what was drawn to where it belongs in another view: what a map that is dragged shows until it is drawn again. */
  align(view: View): void {
    if (this.drawn === null) return;
    const grown = view.scale_px / this.drawn.scale_px;
    const x = this.drawn.left_px * grown - view.left_px;
    const y = this.drawn.top_px * grown - view.top_px;
    this.canvas.style.transform =
      grown === 1 && x === 0 && y === 0 ? "none" : `translate(${x}px, ${y}px) scale(${grown})`;
  }
}

import type { Map as LeafletMap } from "leaflet";

/** A canvas over the whole map, in pixels of the map's container. It lets the mouse through. */
export class Overlay {
  private readonly canvas = document.createElement("canvas");
  private readonly context: CanvasRenderingContext2D;

  constructor(
    private readonly map: LeafletMap,
    class_name: string,
  ) {
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

  /** The context, cleared, one unit a CSS pixel. */
  begin(): CanvasRenderingContext2D {
    const { x, y } = this.map.getSize();
    const ratio = window.devicePixelRatio;
    const width = Math.round(x * ratio);
    const height = Math.round(y * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, x, y);
    return this.context;
  }
}

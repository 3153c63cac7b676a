/** Selects UAVs with a box over the map: Shift and drag, or, with the tool, drag alone; it adds to the selection. */
import { signal } from "@preact/signals";
import L from "leaflet";
import type { MapAccess } from "./map_access";
import type { Pixel } from "./view";

/** Less than this is a click that has slipped [px]. */
const kLeast_px = 6;

export class BoxSelect {
  readonly active = signal(false);
  private readonly box = document.createElement("div");
  private readonly container: HTMLElement;
  private from: Pixel | null = null;
  private release: (() => void) | null = null;

  constructor(
    private readonly access: MapAccess,
    private readonly claimed: () => boolean,
    private readonly onBox: (a: Pixel, b: Pixel) => void,
  ) {
    this.container = access.leaflet.getContainer();
    this.box.className = "select-box";
    this.box.hidden = true;
    this.container.append(this.box);
    // In the capture phase: before Leaflet takes it for the beginning of a drag of the map.
    this.container.addEventListener("pointerdown", this.onDown, true);
  }

  remove(): void {
    this.stop();
    this.container.removeEventListener("pointerdown", this.onDown, true);
    this.box.remove();
  }

  toggle(): void {
    if (this.active.peek()) this.stop();
    else this.start();
  }

  private start(): void {
    this.release = this.access.claim({
      cursor: "crosshair",
      onLost: () => {
        this.stop();
      },
    });
    this.active.value = true;
    this.access.leaflet.dragging.disable();
    this.container.classList.add("boxing");
  }

  private stop(): void {
    this.endBox();
    if (!this.active.peek()) return;
    this.active.value = false;
    this.access.leaflet.dragging.enable();
    this.container.classList.remove("boxing");
    this.release?.();
    this.release = null;
  }

  private readonly onDown = (event: PointerEvent) => {
    const wanted = this.active.peek() || (event.shiftKey && !this.claimed());
    if (!wanted || event.button !== 0 || !event.isPrimary) return;
    this.from = this.pixelOf(event);
    L.DomUtil.disableTextSelection();
    window.addEventListener("pointermove", this.onMove);
    window.addEventListener("pointerup", this.onUp);
    window.addEventListener("pointercancel", this.onCancel);
  };

  private readonly onMove = (event: PointerEvent) => {
    if (this.from === null || !event.isPrimary) return;
    const to = this.pixelOf(event);
    this.box.hidden = false;
    this.box.style.left = `${Math.min(this.from.x, to.x)}px`;
    this.box.style.top = `${Math.min(this.from.y, to.y)}px`;
    this.box.style.width = `${Math.abs(this.from.x - to.x)}px`;
    this.box.style.height = `${Math.abs(this.from.y - to.y)}px`;
  };

  private readonly onUp = (event: PointerEvent) => {
    if (!event.isPrimary) return;
    const from = this.from;
    this.endBox();
    if (from === null) return;
    const to = this.pixelOf(event);
    if (Math.hypot(to.x - from.x, to.y - from.y) < kLeast_px) return;
    this.swallowClick();
    this.onBox(from, to);
    this.stop();
  };

  private readonly onCancel = () => {
    this.endBox();
  };

  private endBox(): void {
    if (this.from !== null) L.DomUtil.enableTextSelection();
    this.from = null;
    this.box.hidden = true;
    window.removeEventListener("pointermove", this.onMove);
    window.removeEventListener("pointerup", this.onUp);
    window.removeEventListener("pointercancel", this.onCancel);
  }

  /** The browser calls the end of the drag a click; it is none. */
  private swallowClick(): void {
    const swallow = (event: Event) => {
      event.stopPropagation();
    };
    this.container.addEventListener("click", swallow, true);
    setTimeout(() => {
      this.container.removeEventListener("click", swallow, true);
    }, 0);
  }

  private pixelOf(event: PointerEvent): Pixel {
    const { left, top } = this.container.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }
}

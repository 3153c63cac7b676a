/** Zoom and pan over a chart: wheel, two fingers, one finger sideways. */

export interface Gestures {
  /** Shows `factor` times as much; `at` is the place that stays, 0 at the left edge and 1 at the right. */
  zoom: (factor: number, at: number) => void;
  /** Moves by a part of what is shown, to the right. */
  pan: (part: number) => void;
  /** Back to everything. */
  reset: () => void;
}

const kZoomPerNotch = 1.25;
const kNotch_px = 100;

/** What is returned takes it all away again. */
export function listenForGestures(over: HTMLElement, gestures: Gestures): () => void {
  const fingers = new Map<number, number>();
  const at = (client_x: number) => {
    const { left, width } = over.getBoundingClientRect();
    return Math.min(Math.max((client_x - left) / width, 0), 1);
  };
  const handlers = {
    wheel: (event: WheelEvent) => {
      event.preventDefault();
      const sideways = event.shiftKey ? event.deltaY : event.deltaX;
      if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
        gestures.pan(sideways / over.clientWidth);
      } else {
        gestures.zoom(kZoomPerNotch ** (event.deltaY / kNotch_px), at(event.clientX));
      }
    },
    pointerdown: (event: PointerEvent) => {
      if (event.pointerType === "touch") fingers.set(event.pointerId, event.clientX);
    },
    pointermove: (event: PointerEvent) => {
      const before = fingers.get(event.pointerId);
      if (before === undefined) return;
      const others = [...fingers].filter(([id]) => id !== event.pointerId);
      fingers.set(event.pointerId, event.clientX);
      const other = others[0]?.[1];
      if (other === undefined) {
        gestures.pan((before - event.clientX) / over.clientWidth);
        return;
      }
      const [apart_before, apart] = [Math.abs(before - other), Math.abs(event.clientX - other)];
      if (apart_before > 10 && apart > 10)
        gestures.zoom(apart_before / apart, at((event.clientX + other) / 2));
    },
    pointerup: (event: PointerEvent) => {
      fingers.delete(event.pointerId);
    },
    dblclick: () => {
      gestures.reset();
    },
  };
  over.addEventListener("wheel", handlers.wheel, { passive: false });
  over.addEventListener("pointerdown", handlers.pointerdown);
  over.addEventListener("pointermove", handlers.pointermove);
  over.addEventListener("pointerup", handlers.pointerup);
  over.addEventListener("pointercancel", handlers.pointerup);
  over.addEventListener("dblclick", handlers.dblclick);
  return () => {
    over.removeEventListener("wheel", handlers.wheel);
    over.removeEventListener("pointerdown", handlers.pointerdown);
    over.removeEventListener("pointermove", handlers.pointermove);
    over.removeEventListener("pointerup", handlers.pointerup);
    over.removeEventListener("pointercancel", handlers.pointerup);
    over.removeEventListener("dblclick", handlers.dblclick);
  };
}

/** One finger or the mouse goes to a time, two fingers or the wheel show more or less of the recording. */

export interface TrackGestures {
  /** To a place on the line [px]. */
  scrub: (x_px: number) => void;
  /** The pointer is there; null: it is gone. */
  point: (x_px: number | null) => void;
  /** Shows `factor` times as much; the place `at_px` stays. */
  zoom: (factor: number, at_px: number) => void;
  /** Moves what is shown by so much, to the right. */
  pan: (by_px: number) => void;
}

const kZoomPerNotch = 1.25;
const kNotch_px = 100;
const kLeastApart_px = 10;

/** What is returned takes it all away again. */
export function listenToTrack(element: HTMLElement, gestures: () => TrackGestures): () => void {
  const down = new Map<number, number>();
  const xOf = (event: MouseEvent) => event.clientX - element.getBoundingClientRect().left;
  const move = (event: PointerEvent) => {
    const x_px = xOf(event);
    gestures().point(x_px);
    const before_px = down.get(event.pointerId);
    if (before_px === undefined) return;
    const other_px = [...down].find(([id]) => id !== event.pointerId)?.[1];
    down.set(event.pointerId, x_px);
    if (other_px === undefined) {
      gestures().scrub(x_px);
      return;
    }
    const [apart_before, apart] = [Math.abs(before_px - other_px), Math.abs(x_px - other_px)];
    if (apart_before > kLeastApart_px && apart > kLeastApart_px)
      gestures().zoom(apart_before / apart, (x_px + other_px) / 2);
  };
  const handlers = {
    pointerdown: (event: PointerEvent) => {
      if (event.button !== 0) return;
      element.setPointerCapture(event.pointerId);
      down.set(event.pointerId, xOf(event));
      // A second finger zooms: it does not jump.
      if (down.size === 1) gestures().scrub(xOf(event));
    },
    pointermove: move,
    lostpointercapture: (event: PointerEvent) => {
      down.delete(event.pointerId);
      if (event.pointerType === "touch") gestures().point(null);
    },
    pointerleave: () => {
      gestures().point(null);
    },
    wheel: (event: WheelEvent) => {
      event.preventDefault();
      const sideways_px = event.shiftKey ? event.deltaY : event.deltaX;
      if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) gestures().pan(sideways_px);
      else gestures().zoom(kZoomPerNotch ** (event.deltaY / kNotch_px), xOf(event));
    },
  };
  const names = Object.keys(handlers) as (keyof typeof handlers)[];
  for (const name of names)
    element.addEventListener(name, handlers[name] as EventListener, { passive: false });
  return () => {
    for (const name of names) element.removeEventListener(name, handlers[name] as EventListener);
  };
}

import { computed, useSignal } from "@preact/signals";
import { useCallback, useEffect, useRef } from "preact/hooks";
import { readColours } from "../map/colours";
import { remembered } from "../state/remembered";
import { theme } from "../state/settings";
import { altitude, distance } from "../units/quantities";
import { draw } from "./canvas_draw";
import { fitted, panned, pick, snapped, toOffset, zoomed, type CanvasView, type Point } from "./canvas_view";
import { moved } from "./draft";
import type { FormationEditor } from "./editor";
import type { EditSession } from "./session";
import { inWords } from "./words";

const kReach_px = 20;
/** A finger is broader than a pointer. */
const kTouchReach_px = 30;
/** A press that moves less than this selects and moves nothing. */
const kStill_px = 4;
const kZoom = 1.25;
/** Snapping, in the unit that is shown; 0: none. */
const kSteps = [0, 10, 50, 100] as const;

const snap_step = remembered<number>(
  "formation.snap",
  10,
  (stored) => kSteps.find((step) => step === stored) ?? null,
);
/** The document has taken the theme on already; reading its colours costs more than drawing a few slots. */
const colours_now = computed(() => {
  void theme.value;
  return readColours();
});
let gestures = 0;

interface SlotCanvasProps {
  editor: FormationEditor;
  session: EditSession;
}

/** The formation from above, forward up. Slots are dragged, or moved with the arrow keys; the rest is drawn as it flies. */
export function SlotCanvas({ editor, session }: SlotCanvasProps) {
  const { store } = editor.station;
  const canvas = useRef<HTMLCanvasElement>(null);
  const size = useSignal({ width_px: 360, height_px: 240 });
  /** Null: fitted to the slots. */
  const view = useSignal<CanvasView | null>(null);

  const draft = session.draft.value;
  const selection = store.selection.value;
  const viewNow = useCallback(
    (): CanvasView =>
      view.value ??
      fitted(
        session.draft.value.slots,
        session.draft.value.limits.radius_m,
        size.value.width_px,
        size.value.height_px,
      ),
    [session, view, size],
  );

  useEffect(() => {
    const element = canvas.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => {
      size.value = { width_px: element.clientWidth, height_px: element.clientHeight };
      view.value = null;
    });
    observer.observe(element);
    return () => {
      observer.disconnect();
    };
  }, [view, size]);

  // A new shape is shown whole; a slot that is dragged out of its shape leaves the picture as it is.
  const shape = draft.shape === "custom" ? "" : `${draft.shape} ${draft.spacing_m}`;
  useEffect(() => {
    if (shape !== "") view.value = null;
  }, [shape, view]);
  useEffect(() => {
    view.value = null;
  }, [draft.lead_m, draft.slots.length, view]);

  const now_ms = store.now_ms.value;
  const colours = colours_now.value;
  const shown = viewNow();
  const conflicting = editor.conflicting.value;
  useEffect(() => {
    const element = canvas.current;
    const context = element?.getContext("2d");
    if (element === null || !context) return;
    const ratio = window.devicePixelRatio;
    const [width, height] = [Math.round(shown.width_px * ratio), Math.round(shown.height_px * ratio)];
    if (element.width !== width || element.height !== height) Object.assign(element, { width, height });
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const ground = editor.ground(now_ms);
    const seen = draft.slots.flatMap(({ vehicle_id }) => {
      const offset = ground === null ? null : editor.seen(vehicle_id, ground, now_ms);
      return offset === null ? [] : [[vehicle_id, offset] as const];
    });
    draw(context, shown, {
      draft,
      selection,
      conflicting,
      seen: new Map(seen),
      colours,
      font: getComputedStyle(element).fontFamily,
      lengthText: (metres) => distance.full(metres),
      unit_m: distance.toSi(1),
    });
  }, [editor, draft, selection, conflicting, now_ms, colours, shown]);

  const step_m = distance.toSi(snap_step.value);
  const members = new Set(draft.slots.map(({ vehicle_id }) => vehicle_id));
  const chosen = [...selection].filter((id) => members.has(id));
  const last = draft.slots.find(({ vehicle_id }) => vehicle_id === chosen.at(-1));

  const zoomBy = (factor: number, at: Point) => {
    view.value = zoomed(viewNow(), factor, at);
  };
  const middle = { x: size.value.width_px / 2, y: size.value.height_px / 2 };

  const press = (down: PointerEvent) => {
    const element = down.currentTarget as HTMLCanvasElement;
    // First: a field that loses the focus changes the draft.
    element.focus();
    const begun = session.draft.peek();
    const start = pointOf(element, down);
    const held = viewNow();
    const reach_px = down.pointerType === "mouse" ? kReach_px : kTouchReach_px;
    const grabbed = pick(held, begun.slots, start, reach_px);
    if (grabbed === null && !down.ctrlKey && !down.metaKey && !down.shiftKey) store.select([]);
    else if (grabbed !== null && (down.ctrlKey || down.metaKey || down.shiftKey)) {
      store.toggleSelected(grabbed.vehicle_id);
    } else if (grabbed !== null && !selection.has(grabbed.vehicle_id)) store.select([grabbed.vehicle_id]);
    const ids = grabbed !== null && selection.has(grabbed.vehicle_id) ? chosen : [grabbed?.vehicle_id ?? 0];
    gestures += 1;
    const gesture = `drag ${gestures}`;
    const label = ids.length > 1 ? `move ${ids.length} slots` : `move ${store.callsign(ids[0])}`;
    let moves = false;
    element.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent) => {
      const at = pointOf(element, event);
      moves ||= Math.hypot(at.x - start.x, at.y - start.y) >= kStill_px;
      if (!moves) return;
      if (grabbed === null) {
        view.value = panned(held, { x: at.x - start.x, y: at.y - start.y });
        return;
      }
      // The picture stands still while a slot is dragged.
      view.value = held;
      const [from, to] = [toOffset(held, start), toOffset(held, at)];
      const step = event.altKey ? 0 : step_m;
      const by = {
        forward_m: snapped(grabbed.forward_m + to.forward_m - from.forward_m, step) - grabbed.forward_m,
        left_m: snapped(grabbed.left_m + to.left_m - from.left_m, step) - grabbed.left_m,
        up_m: 0,
      };
      session.change(moved(begun, new Set(ids), by), label, gesture);
    };
    const end = () => {
      element.removeEventListener("pointermove", move);
      if (moves && grabbed !== null) session.history.endGesture();
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("lostpointercapture", end, { once: true });
    down.preventDefault();
  };

  const nudge = (forward: number, left: number, up: number, times: number) => {
    if (chosen.length === 0) return;
    const level_m = (step_m > 0 ? step_m : distance.toSi(1)) * times;
    const by = {
      forward_m: forward * level_m,
      left_m: left * level_m,
      up_m: up * altitude.toSi(10) * times,
    };
    const label = chosen.length > 1 ? `move ${chosen.length} slots` : `move ${store.callsign(chosen[0])}`;
    session.change(moved(draft, new Set(chosen), by), label, `keys ${chosen.join()}`);
  };
  const goTo = (steps: number) => {
    const { slots } = draft;
    if (slots.length === 0) return;
    const index = last === undefined ? -1 : slots.indexOf(last);
    const next = index < 0 && steps < 0 ? slots.length - 1 : (index + steps + slots.length) % slots.length;
    store.select([slots[next].vehicle_id]);
  };
  const type = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey) return;
    const times = event.shiftKey ? 10 : 1;
    const steer = {
      ArrowUp: () => {
        if (event.altKey) nudge(0, 0, 1, times);
        else nudge(1, 0, 0, times);
      },
      ArrowDown: () => {
        if (event.altKey) nudge(0, 0, -1, times);
        else nudge(-1, 0, 0, times);
      },
      ArrowLeft: () => {
        nudge(0, 1, 0, times);
      },
      ArrowRight: () => {
        nudge(0, -1, 0, times);
      },
      PageDown: () => {
        goTo(1);
      },
      PageUp: () => {
        goTo(-1);
      },
      "+": () => {
        zoomBy(kZoom, middle);
      },
      "-": () => {
        zoomBy(1 / kZoom, middle);
      },
      "0": () => {
        view.value = null;
      },
    }[event.key];
    if (steer === undefined) return;
    steer();
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    <div class="slot-canvas">
      <canvas
        ref={canvas}
        tabIndex={0}
        role="application"
        aria-label="Slots seen from above, forward up"
        aria-describedby="slot-canvas-keys"
        title="Drag slots. Arrow keys move what is selected, with Shift ten times as far, with Alt up and down; Page Up and Page Down go from slot to slot."
        onPointerDown={press}
        onKeyDown={type}
        onWheel={(event) => {
          event.preventDefault();
          zoomBy(event.deltaY < 0 ? kZoom : 1 / kZoom, pointOf(event.currentTarget, event));
        }}
      />
      <p class="visually-hidden" id="slot-canvas-keys">
        Page Up and Page Down go from slot to slot, arrow keys move the selected slots, with Alt up and down.
      </p>
      <div class="canvas-foot">
        <output aria-live="polite">
          {last === undefined
            ? "Drag a slot, or select one."
            : chosen.length > 1
              ? `${chosen.length} slots selected`
              : `${store.callsign(last.vehicle_id)}: ${inWords(last)}`}
        </output>
        <label>
          Snap{" "}
          <select
            value={String(snap_step.value)}
            onChange={(event) => {
              snap_step.value = Number(event.currentTarget.value);
            }}
          >
            {kSteps.map((step) => (
              <option key={step} value={String(step)}>
                {step === 0 ? "off" : `${step} ${distance.unit()}`}
              </option>
            ))}
          </select>
        </label>
        <button
          type="button"
          class="button"
          disabled={view.value === null}
          title="Show all slots (0)"
          onClick={() => {
            view.value = null;
          }}
        >
          Fit
        </button>
      </div>
    </div>
  );
}

function pointOf(element: HTMLElement, event: MouseEvent): Point {
  const box = element.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

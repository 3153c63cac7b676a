import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { why_no_command, why_no_urgent_command } from "../control/control";
import type { Outcome } from "../link/commands";
import { inChosenUnits } from "../units/station_text";

interface CommandButtonProps {
  /** Sends the command. */
  command: () => Promise<Outcome>;
  label: string;
  children: ComponentChildren;
  class?: string;
  /** For switches: what telemetry says. */
  checked?: boolean;
  disabled?: boolean;
  /** For a control in a grid, which has a way of its own to it. */
  tabIndex?: number;
  /** It commands nothing on the bus: also for those who do not hold control. */
  always?: boolean;
  /** Its command takes control if nobody holds it (Control.takenIfFree). */
  urgent?: boolean;
}

const kShowRefusal_ms = 12_000;

/**
 * A button that commands the bus. It waits for the answer, and a refusal is shown right beside it until it is dismissed. Who does not
 * hold control sees that, and is told why when pressing it all the same.
 */
export function CommandButton(props: CommandButtonProps) {
  const button = useRef<HTMLButtonElement>(null);
  const waiting = useSignal(false);
  const refusal = useSignal("");

  const why_not =
    props.always === true ? "" : (props.urgent === true ? why_no_urgent_command : why_no_command).value;

  const press = () => {
    if (waiting.value) return;
    refusal.value = why_not;
    if (why_not !== "") return;
    waiting.value = true;
    void props.command().then((outcome) => {
      waiting.value = false;
      refusal.value = outcome.accepted ? "" : outcome.reason || "Refused.";
    });
  };
  const role =
    props.checked === undefined ? {} : ({ role: "switch", "aria-checked": props.checked } as const);

  return (
    <>
      <button
        type="button"
        ref={button}
        class={props.class ?? "button"}
        aria-label={props.label}
        title={why_not === "" ? props.label : `${props.label}: ${why_not}`}
        aria-disabled={why_not !== ""}
        aria-busy={waiting.value}
        disabled={props.disabled ?? false}
        tabIndex={props.tabIndex}
        onClick={press}
        {...role}
      >
        {props.children}
      </button>
      {refusal.value !== "" && (
        <Refusal
          text={refusal.value}
          anchor={button.current}
          dismiss={() => {
            refusal.value = "";
          }}
        />
      )}
    </>
  );
}

interface RefusalProps {
  text: string;
  anchor: HTMLElement | null;
  dismiss: () => void;
}

/** Beside its control, in the top layer: no table or panel cuts it off or covers it. */
function Refusal({ text, anchor, dismiss }: RefusalProps) {
  const note = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (note.current === null) return;
    note.current.showPopover();
    if (anchor !== null) putBeside(note.current, anchor);
  }, [anchor, text]);
  const dismissed = useRef(dismiss);
  dismissed.current = dismiss;
  useEffect(() => {
    const timer = setTimeout(() => {
      dismissed.current();
    }, kShowRefusal_ms);
    return () => {
      clearTimeout(timer);
    };
  }, [text]);
  return (
    <div class="refusal" role="alert" popover="manual" ref={note}>
      <span>{inChosenUnits(text)}</span>
      <button type="button" class="button quiet" aria-label="Dismiss" onClick={dismiss}>
        ✕
      </button>
    </div>
  );
}

const kGap_px = 8;

/** Above the control where there is room, else below it; never beyond the edge of the window. */
function putBeside(note: HTMLElement, anchor: HTMLElement): void {
  const [box, own] = [anchor.getBoundingClientRect(), note.getBoundingClientRect()];
  const farthest = window.innerWidth - own.width - kGap_px;
  const left = Math.max(kGap_px, Math.min(box.right - own.width, farthest));
  const above = box.top - own.height - kGap_px;
  const top = above >= kGap_px ? above : box.bottom + kGap_px;
  Object.assign(note.style, { left: `${left}px`, top: `${top}px` });
}

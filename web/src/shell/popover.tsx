import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";

interface PopoverProps {
  label: string;
  /** What the button shows. */
  button: ComponentChildren;
  class?: string;
  children: ComponentChildren;
}

/** A button with a small panel below it, closed by Escape, a press outside, or leaving it with the keyboard. */
export function Popover({ label, button, children, ...props }: PopoverProps) {
  const open = useSignal(false);
  const root = useRef<HTMLDivElement>(null);
  const id = useId();
  useLayoutEffect(() => {
    if (!open.value) return;
    const close = (event: Event) => {
      if (event.target instanceof Node && root.current?.contains(event.target)) return;
      open.value = false;
    };
    const escape = (event: KeyboardEvent) => {
      if (event.key !== "Escape" || !(event.target instanceof Node)) return;
      // A button within that went away when it was pressed leaves the focus to nobody.
      if (event.target !== document.body && root.current?.contains(event.target) !== true) return;
      event.preventDefault();
      event.stopPropagation();
      open.value = false;
      root.current?.querySelector("button")?.focus();
    };
    document.addEventListener("keydown", escape, { capture: true });
    document.addEventListener("pointerdown", close);
    document.addEventListener("focusin", close);
    return () => {
      document.removeEventListener("keydown", escape, { capture: true });
      document.removeEventListener("pointerdown", close);
      document.removeEventListener("focusin", close);
    };
  }, [open, open.value]);
  return (
    <div class="popover" ref={root}>
      <button
        type="button"
        class={props.class ?? "bar-button"}
        aria-label={label}
        title={label}
        aria-expanded={open.value}
        aria-controls={id}
        onClick={() => {
          open.value = !open.value;
        }}
      >
        {button}
      </button>
      {open.value && (
        <section class="panel popover-panel" id={id} aria-label={label}>
          {children}
        </section>
      )}
    </div>
  );
}

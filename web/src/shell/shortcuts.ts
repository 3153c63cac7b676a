/** Keyboard shortcuts of the whole page, so that the help can list them. */
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

export interface Shortcut {
  /** As in KeyboardEvent.key, with modifiers before it: "f", "?", "Shift+A", "Ctrl+Shift+z", "Escape". */
  keys: string;
  /** What it does, for the help. */
  label: string;
  /** Heading in the help. */
  group: string;
  run: () => void;
  /** A key that is held down goes on doing it. Not so by default: nobody means to acknowledge ten alarms by resting a finger on a key. */
  repeats?: boolean;
  /** Also while a dialog lies over the page. Others would do what nobody sees. */
  over_dialogs?: boolean;
}

/** A field may go away under somebody's hands, with the connection, say: what is typed on is no shortcut. */
const kMeantForField_ms = 2000;

/** Those that are in force now. Of two with the same keys, the later one counts: that of the panel opened last. */
export const shortcuts = signal<readonly Shortcut[]>([]);

/** Adds shortcuts; what is returned takes them away. */
export function addShortcuts(added: readonly Shortcut[]): () => void {
  shortcuts.value = [...shortcuts.peek(), ...added];
  return () => {
    shortcuts.value = shortcuts.peek().filter((shortcut) => !added.includes(shortcut));
  };
}

/** Shortcuts for as long as a component is shown. `run` may change with each drawing; keys and labels may not. */
export function useShortcuts(wanted: readonly Shortcut[]): void {
  const newest = useRef(wanted);
  newest.current = wanted;
  useEffect(
    () =>
      addShortcuts(
        newest.current.map((shortcut, i) => ({ ...shortcut, run: () => newest.current[i]?.run() })),
      ),
    [],
  );
}

/** "Ctrl+Shift+z" for a key press. Shift is told for letters and named keys; "?" already says it. Meta counts as Ctrl. */
export function keysOf(
  event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">,
): string {
  const letter = /^[a-z]$/i.test(event.key);
  const modifiers = [
    event.ctrlKey || event.metaKey ? "Ctrl" : "",
    event.altKey ? "Alt" : "",
    event.shiftKey && (letter || event.key.length > 1) ? "Shift" : "",
  ].filter(Boolean);
  const key = letter ? event.key.toLowerCase() : event.key === " " ? "Space" : event.key;
  return [...modifiers, key].join("+");
}

/** Letters are for typing while a field has the focus; Ctrl combinations there belong to the field as well. */
function typing(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement)
    return !["checkbox", "radio", "range", "button"].includes(target.type);
  return (
    target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement || target.isContentEditable
  );
}

/** What has the focus is pressed by it. */
function presses(target: EventTarget | null, keys: string): boolean {
  return (
    (keys === "Space" || keys === "Enter") &&
    target instanceof Element &&
    target.matches("button, a[href], summary, input, [role=button], [role=switch], [role=tab], [role=option]")
  );
}

export function listenForShortcuts(): () => void {
  /** The field that was typed in last, and when; null when the person was done with it. */
  let typed: { field: Node; ms: number } | null = null;
  const onKey = (event: KeyboardEvent) => {
    if (typing(event.target)) {
      const done = ["Enter", "Escape", "Tab"].includes(event.key);
      typed = done ? null : { field: event.target as Node, ms: event.timeStamp };
      return;
    }
    if (event.defaultPrevented) return;
    if (typed !== null && !typed.field.isConnected && event.timeStamp - typed.ms < kMeantForField_ms) {
      typed.ms = event.timeStamp;
      event.preventDefault();
      return;
    }
    const keys = keysOf(event);
    if (presses(event.target, keys)) return;
    const shortcut = shortcuts.peek().findLast((one) => one.keys.toLowerCase() === keys.toLowerCase());
    if (shortcut === undefined) return;
    // Escape, too: the browser closes the dialog by it.
    if (shortcut.over_dialogs !== true && document.querySelector("dialog:modal") !== null) return;
    event.preventDefault();
    if (!event.repeat || shortcut.repeats === true) shortcut.run();
  };
  const onPointer = () => {
    typed = null;
  };
  document.addEventListener("keydown", onKey);
  document.addEventListener("pointerdown", onPointer);
  return () => {
    document.removeEventListener("keydown", onKey);
    document.removeEventListener("pointerdown", onPointer);
  };
}

/** A signal whose value this browser remembers. */
import { effect, signal, type Signal } from "@preact/signals";

/** `check` turns what was stored, by whatever version of the page, into a value or null. Where storage is forbidden, nothing is remembered. */
export function remembered<T>(key: string, otherwise: T, check: (stored: unknown) => T | null): Signal<T> {
  const name = `skein.${key}`;
  const value = signal(read(name, check) ?? otherwise);
  effect(() => {
    const text = JSON.stringify(value.value);
    try {
      if (text === JSON.stringify(otherwise)) localStorage.removeItem(name);
      else localStorage.setItem(name, text);
    } catch {
      // No storage: it holds until the page is closed.
    }
  });
  return value;
}

export function oneOf<T extends string>(...choices: readonly T[]): (stored: unknown) => T | null {
  return (stored) => choices.find((choice) => choice === stored) ?? null;
}

export const yesOrNo = (stored: unknown): boolean | null => (typeof stored === "boolean" ? stored : null);

export function within(least: number, most: number): (stored: unknown) => number | null {
  return (stored) =>
    typeof stored === "number" && Number.isFinite(stored) ? Math.min(Math.max(stored, least), most) : null;
}

function read<T>(name: string, check: (stored: unknown) => T | null): T | null {
  try {
    const text = localStorage.getItem(name);
    return text === null ? null : check(JSON.parse(text));
  } catch {
    return null;
  }
}

/** What clicks and keys in the table do to the selection. */
import type { Store } from "../state/store";

/** A plain click selects one and no other (again: none), Ctrl adds or takes out, Shift selects from `anchor` to here. */
export function clickRow(
  store: Store,
  shown: readonly number[],
  id: number,
  anchor: number | null,
  keys: { shift: boolean; ctrl: boolean },
): void {
  const selection = store.selection.value;
  if (keys.shift) {
    const from = shown.indexOf(anchor ?? id);
    const to = shown.indexOf(id);
    const range = shown.slice(Math.min(from < 0 ? to : from, to), Math.max(from, to) + 1);
    // The one that was clicked is the last one selected.
    if (from > to) range.reverse();
    store.select(keys.ctrl ? [...selection, ...range] : range);
  } else if (keys.ctrl) {
    store.toggleSelected(id);
  } else {
    store.select(selection.size === 1 && selection.has(id) ? [] : [id]);
  }
}

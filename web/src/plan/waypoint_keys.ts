/** What keys do on a waypoint, on the map and in the table alike. */
import type { PathDraft } from "./path_draft";

const kNudge_m = 10;
const kWays: Readonly<Record<string, readonly [east: number, north: number]>> = {
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
};

export const kKeysHint = "Arrow keys move it 10 m, with Shift 100 m, with Alt 1 m; Delete deletes it.";

/** Arrow keys move the waypoint, Delete deletes it. Whether the key was of use. */
export function pressOnWaypoint(draft: PathDraft, index: number, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey) return false;
  const way = kWays[event.key];
  if (way !== undefined) {
    const step_m = kNudge_m * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    draft.selected.value = index;
    draft.nudge(way[0] * step_m, way[1] * step_m);
  } else if (event.key === "Delete" || event.key === "Backspace") draft.remove(index);
  else return false;
  // Else the map would be moved as well, or a shortcut of the page would be run.
  event.preventDefault();
  event.stopPropagation();
  return true;
}

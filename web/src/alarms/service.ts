/** Whether alarms can come at all: a page without them must not look like a sky without trouble. */
import { replay } from "../state/replay";
import type { Store } from "../state/store";

export const kMonitor = "collision-monitor";
/** The monitor sends its list once a second; a bridge that has just started may not have heard it yet. */
const kPatience_ms = 4000;

/** Why no alarms can come, in a sentence; "" while they can. */
export function whyNoAlarms(store: Store, now_ms: number): string {
  const replayed = replay.value !== null;
  if (store.connection.value.kind === "signed out") return "No alarms can come: sign in first.";
  if (store.connection.value.kind !== "open")
    return replayed ? "web-bridge can't be reached." : "No alarms can come: web-bridge can't be reached.";
  if (store.silent_nodes.value.includes(kMonitor))
    return replayed
      ? `No alarms could come then: ${kMonitor} was silent.`
      : `No alarms can come: ${kMonitor} is silent.`;
  // With no fleet there is nothing to warn of.
  const expected = store.fleet.motion !== null && now_ms - store.hello_ms > kPatience_ms;
  if (store.alarms.value !== null || !expected) return "";
  return replayed
    ? `No alarms could come then: ${kMonitor} wasn't heard.`
    : `No alarms can come: ${kMonitor} isn't running.`;
}

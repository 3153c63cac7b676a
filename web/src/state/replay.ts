/** Whether what the page shows happens now, or has been. */
import { signal } from "@preact/signals";

/** "player": somebody plays a recording on the bridge's bus. "log": the bridge reads it, and the page says what is played. */
export interface Replay {
  kind: "player" | "log";
  name: string;
  /** How many times as fast as it was a player plays it. */
  speed?: number;
}

/** Null: live. */
export const replay = signal<Replay | null>(null);

/** Why nothing can be commanded; "" when live. */
export function whyReplay(shown: Replay | null): string {
  return shown === null ? "" : "This is a replay: nothing can be commanded";
}

/** The bridge serves recordings alone, and none of them is open yet. */
export function nothingIsOpen(shown: Replay | null): boolean {
  return shown?.kind === "log" && shown.name === "";
}

/** The recording that a page's address asks for; null: none. */
export function recordingIn(search: string): string | null {
  const name = new URLSearchParams(search).get("recording");
  return name === null || name === "" ? null : name;
}

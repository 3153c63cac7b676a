/** Whether the flight is being recorded, as a page may say it: believed only for as long as flight-recorder is heard. */
import { replay } from "../state/replay";
import { person_name } from "../control/control";
import type { Commands, Outcome } from "../link/commands";
import type { RecordingBody, RecordingStatus } from "../link/messages";
import type { Store } from "../state/store";

const kRecording = 1;
/** It says so once a second. */
const kSilence_ms = 3000;
/** Longer than the silence: a bridge or a recorder that has just started may not have been heard yet. */
const kPatience_ms = 4000;
export const kLongestMarker = 200;

export type RecordingView =
  /** There is nothing to record, or nothing to know it from yet. */
  | { kind: "none" }
  | { kind: "recording"; status: RecordingStatus; elapsed_s: number }
  /** `wanted`: an operator did not stop it. `reachable`: somebody is there to start it. */
  | { kind: "not"; why: string; wanted: boolean; reachable: boolean };

export function recordingView(store: Store, now_ms: number): RecordingView {
  // Of a replay nothing is recorded, and nobody misses it.
  if (store.connection.value.kind !== "open" || replay.value !== null) return { kind: "none" };
  const status = store.recording.value;
  const silence_ms = now_ms - store.recording_ms;
  if (status !== null && silence_ms < kSilence_ms) {
    if (status.state !== kRecording)
      return { kind: "not", why: status.reason, wanted: status.state !== 0, reachable: true };
    const elapsed_s = (status.utime - status.started_utime) / 1e6 + silence_ms / 1000;
    return { kind: "recording", status, elapsed_s };
  }
  const why = "flight-recorder isn't heard; scripts/run or scripts/record starts it";
  if (status !== null) return { kind: "not", why, wanted: true, reachable: false };
  // With no fleet there is nothing to miss.
  const expected = store.fleet.motion !== null && now_ms - store.hello_ms > kPatience_ms;
  return expected ? { kind: "not", why, wanted: true, reachable: false } : { kind: "none" };
}

/** What is wrong with a marker's text; "" when nothing is. */
export function markerProblem(text: string): string {
  if (text.trim() === "") return "Type what is to be noted.";
  return [...text.trim()].length > kLongestMarker ? `At most ${kLongestMarker} characters.` : "";
}

/** Sends it with the name of the person at this browser, when there is one. */
export function sendRecording(commands: Commands, body: RecordingBody): Promise<Outcome> {
  const name = person_name.value.trim();
  return commands.request("CMD_RECORDING", name === "" ? body : { ...body, operator_name: name });
}

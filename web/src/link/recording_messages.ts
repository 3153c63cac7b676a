/** Recordings: what the live link says of one that is played, and what is asked by HTTP (cpp/bridge/README.md). */

export interface RecordingsServed {
  /** There is a live flight to go back to. */
  live_bus: boolean;
  /** The bridge serves this one alone. */
  only: string | null;
}

/** What is played of a recording. Times are seconds since its first event. */
export interface PlaybackMessage {
  type: "playback";
  state: "opening" | "paused" | "playing" | "ended" | "failed";
  t_s: number;
  duration_s: number;
  /** Of the recording's first event. */
  start_utime: number;
  /** 0.1 to 50. */
  speed: number;
  direction: 1 | -1;
  loop: [number, number] | null;
  /** Of opening, 0 to 1. */
  progress: number;
  /** Why it failed. */
  problem: string;
}

/** Time has jumped: what was heard so far counts no more, and a whole picture of the moment follows, ended by "playback". */
export interface Reset {
  type: "reset";
}

export type PlaybackBody =
  | { action: "play" | "pause" }
  | { action: "seek"; t_s: number }
  | { action: "step"; steps: number }
  | { action: "speed"; speed: number }
  | { action: "loop"; loop: [number, number] | null };

/** GET /api/recordings. Null is what is not known before it is indexed. */
export interface RecordingList {
  folder: string;
  live_bus: boolean;
  recordings: ListedRecording[];
}

export interface ListedRecording {
  name: string;
  scenario: string | null;
  start_utime: number | null;
  duration_s: number | null;
  bytes: number;
  parts: number;
  vehicles: number | null;
  alarms: number | null;
  /** Alarms of that severity. */
  warnings: number | null;
  markers: number | null;
  indexed: boolean;
  /** Of indexing, 0 to 1. */
  progress: number;
  recording_now: boolean;
  /** Why it cannot be opened; "". */
  problem: string;
}

/** GET /api/recordings/NAME. */
export interface RecordingInfo {
  name: string;
  scenario: string;
  start_utime: number;
  duration_s: number;
  bytes: number;
  parts: number;
  vehicles: number;
  recording_now: boolean;
  density: { bin_s: number; events: number[]; warnings: number[] };
  /** By time. */
  marks: Mark[];
  /** Each start of a scenario that it holds. */
  flights: { t_s: number; start_utime: number; scenario: string }[];
  channels: { name: string; count: number; bytes: number; known: boolean; undecodable: number }[];
  damage: Damage[];
}

export interface Mark {
  t_s: number;
  /** "marker" is somebody's note; an alarm is marked when it was raised. */
  kind: "event" | "alarm" | "marker";
  severity: number;
  code: string;
  text: string;
}

export interface Damage {
  t_s: number;
  bytes: number;
  reason: string;
}

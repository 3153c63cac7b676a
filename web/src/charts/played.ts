/** The charts of a recording: all of its flight is there, and a moment of it is played. */
import type { Station } from "../shell/station";
import type { EventMark } from "./event_marks";
import type { Span } from "./time_window";

export interface Played {
  /** What is played, on the charts' axis: since the scenario's start [s]. */
  t_s: number;
  go: (t_s: number) => void;
  /** Marks of the whole recording, oldest first. */
  marks: (span: Span) => EventMark[];
}

/** Null: no recording is open, or it is not known yet where it begins. */
export function playedOf({ player, store }: Station, start_utime: number, now_ms: number): Played | null {
  const recorded_utime = player.start_utime();
  const info = player.info.value;
  if (player.name.value === "" || recorded_utime === null || start_utime === 0) return null;
  const ahead_s = (recorded_utime - start_utime) / 1e6;
  const utime = store.utimeAt(now_ms);
  return {
    t_s: utime === null ? player.at_s(now_ms) + ahead_s : (utime - start_utime) / 1e6,
    go: (t_s) => {
      player.seek(t_s - ahead_s);
    },
    marks: ({ from_s, to_s }) =>
      (info?.marks ?? [])
        .map(({ t_s, severity, text }) => ({ t_s: t_s + ahead_s, severity, text }))
        .filter(({ t_s }) => t_s >= from_s && t_s <= to_s),
  };
}

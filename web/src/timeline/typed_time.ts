/** Times as people type them to go there. */

const kClock = /^(?:(\d+):)?([0-5]?\d):([0-5]?\d(?:\.\d+)?)$/;
const kDay_s = 86_400;
const kHowTo =
  'Type "1:30" or "90" into the recording, "+10" or "-10" from here, or "14:30:05Z" by the clock.';

export interface Recorded {
  at_s: number;
  duration_s: number;
  /** Of its first event. */
  start_utime: number;
}

export type Typed = { t_s: number } | { problem: string };

/** A time of the recording [s], or why what was typed is none. */
export function parseTime(text: string, { at_s, duration_s, start_utime }: Recorded): Typed {
  const typed = text
    .trim()
    .replace(/\u2212/g, "-")
    .replace(/^t\+?\s*(?=\d)/i, "");
  const wall = /^(.*:\d[\d.]*)\s*(?:z|utc)$/i.exec(typed);
  if (wall !== null) {
    const of_day_s = seconds(padded(wall[1] ?? ""));
    if (of_day_s === null) return { problem: kHowTo };
    const start_s = start_utime / 1e6;
    // The first time that the clock said so after the recording's start.
    const t_s = (((of_day_s - (start_s % kDay_s)) % kDay_s) + kDay_s) % kDay_s;
    // The start itself may be a part of a second later than the clock says.
    return within(t_s > kDay_s - 1 ? 0 : t_s, duration_s);
  }
  const sign = /^[+-]/.exec(typed)?.[0];
  const value_s = seconds(sign === undefined ? typed : typed.slice(1));
  if (value_s === null) return { problem: kHowTo };
  if (sign === undefined) return within(value_s, duration_s);
  return { t_s: Math.min(Math.max(at_s + (sign === "+" ? value_s : -value_s), 0), duration_s) };
}

function within(t_s: number, duration_s: number): Typed {
  return t_s <= duration_s ? { t_s } : { problem: "The recording ends before that." };
}

/** By the clock, "14:30" is an hour and a minute. */
function padded(text: string): string {
  return /^\d{1,2}:\d{2}$/.test(text) ? `${text}:00` : text;
}

function seconds(text: string): number | null {
  if (/^\d+(\.\d+)?$/.test(text)) return Number(text);
  const match = kClock.exec(text);
  if (match === null) return null;
  return 3600 * Number(match[1] ?? 0) + 60 * Number(match[2]) + Number(match[3]);
}

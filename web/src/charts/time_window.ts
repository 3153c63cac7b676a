/** Which part of the flight the charts show. */

/** The newest so many seconds, moving on (Infinity: everything), or a part that stands still. */
export type TimeWindow = { last_s: number } | { from_s: number; to_s: number };

export const kAll: TimeWindow = { last_s: Infinity };
const kLeast_s = 2;

export interface Span {
  from_s: number;
  to_s: number;
}

/** What is shown when the flight has reached from `start_s` to `now_s`. */
export function spanOf(window: TimeWindow, start_s: number, now_s: number): Span {
  if ("from_s" in window) return window;
  const from_s = Math.max(now_s - window.last_s, start_s);
  return { from_s, to_s: Math.max(now_s, from_s + kLeast_s) };
}

/** Shows `factor` times as much (below 1: closer), with `at_s` staying where it is on the screen. */
export function zoom(span: Span, factor: number, at_s: number, start_s: number, now_s: number): TimeWindow {
  const from_s = at_s - (at_s - span.from_s) * factor;
  const to_s = at_s + (span.to_s - at_s) * factor;
  return within({ from_s, to_s }, start_s, now_s);
}

/** Moves by a part of what is shown: 0.1 is a tenth to the right. */
export function pan(span: Span, part: number, start_s: number, now_s: number): TimeWindow {
  const length_s = span.to_s - span.from_s;
  const from_s = Math.min(
    Math.max(span.from_s + part * length_s, start_s),
    Math.max(now_s - length_s, start_s),
  );
  return within({ from_s, to_s: from_s + length_s }, start_s, now_s);
}

/** What holds the whole flight is all of it, and what ends with it moves on with it. */
function within(span: Span, start_s: number, now_s: number): TimeWindow {
  const middle_s = (span.from_s + span.to_s) / 2;
  const half_s = Math.max(span.to_s - span.from_s, kLeast_s) / 2;
  const from_s = Math.max(middle_s - half_s, start_s);
  const to_s = middle_s + half_s;
  const reaches_now = to_s >= now_s;
  if (reaches_now && from_s <= start_s) return kAll;
  return reaches_now ? { last_s: now_s - from_s } : { from_s, to_s: Math.max(to_s, from_s + kLeast_s) };
}

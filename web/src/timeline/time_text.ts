/** Times of a recording as text. */
import { clock } from "../units/format";

/** h:mm:ss.t; rounded down, as clocks do. */
export function clockTenths(t_s: number): string {
  // A hair is added, or 0.3 would be 0.2.
  const tenths = Math.floor(Math.max(0, t_s) * 10 + 1e-6);
  return `${clock(Math.floor(tenths / 10))}.${tenths % 10}`;
}

/** As short as the recording allows: minutes and seconds while there are no hours. */
export function tickLabel(t_s: number, longest_s: number): string {
  const text = clock(t_s);
  return longest_s < 3600 ? text.slice(2) : text;
}

/** A time on the bus [us] with its day, in UTC. */
export function utcDay(utime: number): string {
  return new Date(utime / 1000).toISOString().slice(0, 10);
}

/** For screen readers: "12 minutes 5 seconds". */
export function spoken(t_s: number): string {
  const whole = Math.floor(t_s);
  const parts = [
    [Math.floor(whole / 3600), "hour"],
    [Math.floor(whole / 60) % 60, "minute"],
    [whole % 60, "second"],
  ] as const;
  const said = parts.filter(([count]) => count > 0).map(([n, unit]) => `${n} ${unit}${n === 1 ? "" : "s"}`);
  return said.length === 0 ? "0 seconds" : said.join(" ");
}

/** Numbers as people read them. SI in, text out; a missing value is an em dash. */

export const kNone = "—";
const kMinus = "\u2212";

/** Fixed decimals with a true minus sign, and no "-0". */
export function fixed(value: number, decimals = 0): string {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? kMinus + text : text;
}

/** As `fixed`; negative values, with which the bus says "none", give an em dash. */
export function fixedOrNone(value: number, decimals = 0): string {
  return value < 0 ? kNone : fixed(value, decimals);
}

/** Course as compass degrees, three digits: 000 is north, 090 east. */
export function compass(course_rad: number): string {
  return compassOf(Math.PI / 2 - course_rad);
}

/** A compass direction, clockwise from north, as three digits. */
export function compassOf(bearing_rad: number): string {
  const degrees = Math.round((bearing_rad * 180) / Math.PI);
  return String(((degrees % 360) + 360) % 360).padStart(3, "0");
}

/** Seconds as h:mm:ss, with a minus sign before zero. */
export function clock(seconds: number): string {
  const whole = Math.floor(Math.abs(seconds));
  const two = (n: number) => String(n).padStart(2, "0");
  const text = `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return seconds < 0 && whole > 0 ? kMinus + text : text;
}

/** A time on the bus [us] as UTC hh:mm:ss. */
export function utc(utime: number): string {
  return new Date(utime / 1000).toISOString().slice(11, 19);
}

/** A time on the bus [us] since the scenario's start; as UTC when it was before, or the start is not known. */
export function missionTime(utime: number, start_utime: number): string {
  return start_utime > 0 && utime >= start_utime ? `T+ ${clock((utime - start_utime) / 1e6)}` : utc(utime);
}

/** A span of time in words as short as can be: "8 s", "3 min 20 s", "2 h 5 min". */
export function duration(seconds: number): string {
  const whole = Math.max(0, Math.floor(seconds));
  if (whole < 60) return `${whole} s`;
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(whole / 3600)} h ${Math.floor(whole / 60) % 60} min`;
}

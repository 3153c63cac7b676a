/** For how long a link has been lost, in words. */
import { duration } from "./format";

/** A link whose UAV was heard so lately is lost no longer than until the monitor is sure of it. */
const kHeardAgain_s = 2;

/**
 * "climbing 200 m: link of UAV3 lost" becomes "... lost 12 s ago": since then nothing was heard, or obeyed. The text is the
 * controller's and comes a few times a second; the age goes on here even when nothing comes.
 */
export function withLossAge(text: string, age_s: number | null): string {
  if (age_s === null) return text;
  return text.replace(/\blink of (.+?) lost\b/, (words) =>
    age_s < kHeardAgain_s ? `${words}, heard again` : `${words} ${Math.floor(age_s)} s ago`,
  );
}

/** Beside the ghost of a lost UAV. */
export function lostText(age_s: number): string {
  return age_s < kHeardAgain_s ? "lost, heard again" : `lost ${duration(age_s)}`;
}

/** What the station is doing with a formation, in words: the controller's text, with what goes with time added by the page. */

import { duration } from "../units/format";

/** formation_status_t's modes. */
export const kModes = ["Assembling", "In formation", "Avoiding", "Rejoining", "Holding", "Waiting"] as const;
const [kAvoiding, kRejoining, kHolding] = [2, 3, 4];

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

/** What a mode waits for to end, when no time for it is known; "": it has no end. */
export function endOf(mode: number, hold: boolean): string {
  switch (mode) {
    case kAvoiding:
      return "until the link is back";
    case kRejoining:
      return "until all are in place";
    case kHolding:
      return hold ? "until Resume" : "until there is a path";
    default:
      return "";
  }
}

/** A text that only repeats the mode's name says nothing. */
export function sameWords(text: string, mode: string): boolean {
  return text === "" || text.toLowerCase() === mode.toLowerCase();
}

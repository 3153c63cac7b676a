/** What the station is doing with a formation, in words: the controller's text, with what goes with time added by the page. */

/**
 * "climbing 200 m: link of UAV3 lost" becomes "... lost 12 s ago": since then nothing was heard, or obeyed. The text is the
 * controller's and comes a few times a second; the age goes on here even when nothing comes.
 */
export function withLossAge(text: string, age_s: number | null): string {
  if (age_s === null) return text;
  return text.replace(/\blink of (.+?) lost\b/, (words) => `${words} ${Math.floor(age_s)} s ago`);
}

/** A text that only repeats the mode's name says nothing. */
export function sameWords(text: string, mode: string): boolean {
  return text === "" || text.toLowerCase() === mode.toLowerCase();
}

/** What the station is doing with a formation, in words. */
/** formation_status_t's modes. */
export const kModes = ["Assembling", "In formation", "Avoiding", "Rejoining", "Holding", "Waiting"] as const;
const [kAvoiding, kRejoining, kHolding] = [2, 3, 4];

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

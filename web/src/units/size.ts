import { fixed } from "./format";

const kUnits = ["B", "kB", "MB", "GB", "TB"] as const;

/** A number of bytes: "730 B", "1.4 MB", "25 GB". */
export function size(bytes: number): string {
  const power = Math.min(Math.max(Math.floor(Math.log10(Math.max(bytes, 1)) / 3), 0), kUnits.length - 1);
  const value = bytes / 1000 ** power;
  // What would be rounded up to 1000 is one of the next unit.
  if (value >= 999.5 && power < kUnits.length - 1) return `1.0 ${kUnits[power + 1]}`;
  return `${fixed(value, power > 0 && value < 9.95 ? 1 : 0)} ${kUnits[power]}`;
}

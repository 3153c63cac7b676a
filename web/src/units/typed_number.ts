/** Numbers as people type them. */

export interface NumberLimits {
  least: number;
  most: number;
  unit: string;
  /** A word that may be typed for zero. */
  zero?: string;
}

/** Takes a decimal comma, a true minus sign and spaces in; null: no number. The word for zero, or nothing, is zero. */
export function parseNumber(text: string, zero?: string): number | null {
  const clean = text.trim().replace(/\s/g, "").replace("\u2212", "-").replace(",", ".");
  if (zero !== undefined && (clean === "" || clean.toLowerCase() === zero)) return 0;
  if (!/^[-+]?(\d+\.?\d*|\.\d+)$/.test(clean)) return null;
  return Number(clean);
}

/** What is wrong with what was typed, with what would be right; null: nothing. */
export function numberProblem(text: string, { least, most, unit, zero }: NumberLimits): string | null {
  const value = parseNumber(text, zero);
  const word = zero === undefined ? "" : `, or “${zero}”`;
  const range = `${round(least)} to ${round(most)}${unit === "" ? "" : ` ${unit}`}${word}`;
  if (value === null) return `Not a number: ${range}.`;
  if (value < least - kSlack || value > most + kSlack) return `Must be ${range}.`;
  return null;
}

/** For limits that are round in SI and not in the unit that is shown. */
const kSlack = 1e-6;
const round = (value: number) => String(Number(value.toFixed(1)));

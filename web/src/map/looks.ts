/** Which looks a symbol can have: one image is made of each. */

/** How much is drawn of each UAV: all, smaller symbols, or dots where a crowd is. */
export type Detail = "full" | "small" | "dots";

const kDetails: readonly Detail[] = ["full", "small", "dots"];

/** Steps of heading: at 5 degrees a wing tip is never more than half a pixel off. */
export const kHeadings = 72;

/** The step of heading, 0..kHeadings-1, nearest to a compass direction. */
export function headingStep(compass_rad: number): number {
  const step = Math.round((compass_rad / (2 * Math.PI)) * kHeadings) % kHeadings;
  return step < 0 ? step + kHeadings : step;
}

export const headingOf = (step: number) => (step / kHeadings) * 2 * Math.PI;

/** One number for each look: a text for every symbol of every frame would be garbage to collect. */
export function keyOf(kind: number, detail: Detail, identity: number, step: number): number {
  return ((kind * kDetails.length + kDetails.indexOf(detail)) * 8 + identity) * kHeadings + step;
}

const kSymbol_px2 = 26 * 26;

/** What a view has room for, by the part of it that full symbols would cover. */
export function detailOf(symbols: number, width_px: number, height_px: number): Detail {
  const covered = (symbols * kSymbol_px2) / Math.max(1, width_px * height_px);
  return covered < 0.4 ? "full" : covered < 1.5 ? "small" : "dots";
}

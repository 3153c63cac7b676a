/** Lines gathered by colour: a stroke costs more than what is in it. */
import { kIdentities, type Colours } from "./colours";
import type { Pixel } from "./view";

/** A path for each identity. */
export function identityPaths(): readonly Path2D[] {
  return Array.from({ length: kIdentities }, () => new Path2D());
}

export function strokeAll(
  context: CanvasRenderingContext2D,
  all: readonly Path2D[],
  colours: Colours,
  width_px: number,
): void {
  context.lineWidth = width_px;
  all.forEach((path, i) => {
    context.strokeStyle = colours.identity[i] ?? colours.text;
    context.stroke(path);
  });
}

export function segment(path: Path2D | undefined, a: Pixel, b: Pixel): void {
  path?.moveTo(a.x, a.y);
  path?.lineTo(b.x, b.y);
}

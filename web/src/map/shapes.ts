/** Symbols of the map. All are drawn around (0, 0), pointing up the screen. */

/** A long-winged aircraft from above. */
export const kAircraft = new Path2D(
  "M0 -12C1.500 -12 1.900 -9 1.900 -6.500L1.900 -3.500L13 0.800L13 3.200L1.900 1.900L1.500 7.800L5.200 9.900L5.200 11.600" +
    "L0 10.800L-5.200 11.600L-5.200 9.900L-1.500 7.800L-1.900 1.900L-13 3.200L-13 0.800L-1.900 -3.500L-1.900 -6.500" +
    "C-1.900 -9 -1.500 -12 0 -12Z",
);

/** The virtual leader: an open arrowhead, for nothing flies there. */
export const kLeader = new Path2D("M0 -10L8 9L0 4.500L-8 9Z");

/** A slot: a ring with four ticks, to be filled by a UAV. */
export const kSlot = new Path2D(
  "M10 0A10 10 0 1 1 -10 0A10 10 0 1 1 10 0M0 -10V-14M0 10V14M-10 0H-14M10 0H14",
);

/** A waypoint: the four-pointed star of aeronautical charts. */
export const kWaypoint = new Path2D(
  "M0 -6L1.600 -1.600L6 0L1.600 1.600L0 6L-1.600 1.600L-6 0L-1.600 -1.600Z",
);

/** Who flies in no formation, after TCAS: an open diamond. */
export const kTraffic = new Path2D("M0 -12L12 0L0 12L-12 0Z");

/** By level, after TCAS: nothing, a diamond, a circle, a square, all filled. The table's lamps have the same shapes. */
export const kLevelFrames: readonly (Path2D | null)[] = [
  null,
  new Path2D("M0 -22L22 0L0 22L-22 0Z"),
  new Path2D("M18 0A18 18 0 1 1 -18 0A18 18 0 1 1 18 0Z"),
  new Path2D("M-17 -17H17V17H-17Z"),
];

/** How far a symbol reaches from its middle, with its frame [px]. */
export const kSymbolRadius_px = 15;
export const kFrameRadius_px = 22;
export const kWaypointRadius_px = 6;

/** Draws with (0, 0) at a point and up the screen turned to a compass direction. */
export function at(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  compass_rad: number,
  draw: (context: CanvasRenderingContext2D) => void,
): void {
  context.save();
  context.translate(x, y);
  context.rotate(compass_rad);
  draw(context);
  context.restore();
}

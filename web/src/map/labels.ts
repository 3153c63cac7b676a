/** Where labels go so that they cover one another and the symbols as little as can be. */

export interface LabelRequest {
  /** Tells a label from all others, and finds it again next time. */
  key: string;
  /** The symbol's middle [px]. */
  x: number;
  y: number;
  /** Where it flies, a direction on the screen: the label rather goes elsewhere. */
  heading_x: number;
  heading_y: number;
  /** How far the label must stay from it [px]. */
  clearance: number;
  width: number;
  height: number;
  /** Size with the first line alone. */
  compact_width: number;
  compact_height: number;
}

export interface PlacedLabel {
  key: string;
  /** From the symbol's middle to the label's top left corner [px]. */
  dx: number;
  dy: number;
  width: number;
  height: number;
  /** Only the first line fits. */
  compact: boolean;
  /** Which of the places around the symbol it took. */
  side: number;
}

/** [px] */
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Directions from the symbol, the most readable first. */
const kSides = [
  [1, 0],
  [-1, 0],
  [1, -1],
  [1, 1],
  [-1, -1],
  [-1, 1],
  [0, 1],
  [0, -1],
] as const;

/** More than this part of a label may not be covered. */
const kMostCovered = 0.04;
/** What it costs to lie right ahead of the symbol, over its velocity vector. */
const kAheadCost = 0.3;
/** A label keeps its side while that is not worse than the best by more than this part of it: no flicker. */
const kPatience = 0.1;

/**
 * Labels for `requests`, the most important first; those that find no room are left out.
 * @param covers what lies over the map, where nobody could read a label
 */
export function placeLabels(
  requests: readonly LabelRequest[],
  earlier: ReadonlyMap<string, PlacedLabel>,
  covers: readonly Box[] = [],
): PlacedLabel[] {
  const symbols = requests.map((r) => around(r.x, r.y, r.clearance * 0.8));
  const taken: Box[] = [...covers];
  const placed: PlacedLabel[] = [];
  requests.forEach((request, i) => {
    const obstacles = [...taken, ...symbols.filter((_, j) => j !== i)];
    for (const compact of [false, true]) {
      const best = bestSide(request, compact, obstacles, earlier.get(request.key)?.side);
      if (best === null) continue;
      taken.push(best.box);
      placed.push({
        key: request.key,
        dx: best.box.left - request.x,
        dy: best.box.top - request.y,
        width: best.box.right - best.box.left,
        height: best.box.bottom - best.box.top,
        compact,
        side: best.side,
      });
      break;
    }
  });
  return placed;
}

function bestSide(
  request: LabelRequest,
  compact: boolean,
  obstacles: readonly Box[],
  earlier: number | undefined,
): { box: Box; side: number } | null {
  let best: { box: Box; side: number; cost: number } | null = null;
  for (let side = 0; side < kSides.length; side += 1) {
    const box = boxAt(request, compact, side);
    const covered = obstacles.reduce((sum, other) => sum + overlap(box, other), 0) / area(box);
    if (covered > kMostCovered) continue;
    const [across, down] = kSides[side] ?? kSides[0];
    const ahead = (across * request.heading_x + down * request.heading_y) / Math.hypot(across, down);
    const cost =
      covered + kAheadCost * Math.max(0, ahead) + side * 0.001 - (side === earlier ? kPatience : 0);
    if (best === null || cost < best.cost) best = { box, side, cost };
  }
  return best;
}

function boxAt(request: LabelRequest, compact: boolean, side: number): Box {
  const [across, down] = kSides[side] ?? kSides[0];
  const width = compact ? request.compact_width : request.width;
  const height = compact ? request.compact_height : request.height;
  const reach = across !== 0 && down !== 0 ? request.clearance * 0.7 : request.clearance;
  const left = request.x + across * reach - (across === 0 ? width / 2 : across < 0 ? width : 0);
  const top = request.y + down * reach - (down === 0 ? height / 2 : down < 0 ? height : 0);
  return { left, top, right: left + width, bottom: top + height };
}

function around(x: number, y: number, radius: number): Box {
  return { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius };
}

function area(box: Box): number {
  return (box.right - box.left) * (box.bottom - box.top);
}

function overlap(a: Box, b: Box): number {
  const width = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const height = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

/** What TCAS shows of a threat: where both come closest, and how much higher or lower each is than the other. */
import type { LocalFrame } from "../units/geodesy";
import { altitude } from "../units/quantities";
import type { Colours } from "./colours";
import { kFrameRadius_px } from "./shapes";
import type { Sight, Sights } from "./sights";
import { segment } from "./strokes";
import type { TextImages } from "./text_images";
import { climbArrow, closestApproach, type Mover, type Point } from "./threats";
import { pixelOf, type View } from "./view";

const kTagFont = "650 11.5px 'Inter Variable', sans-serif";
const kTagPadding_px = 3;
const kTagHeight_px = 17;
const kMark_px = 4;

/** A UAV and the one that is the reason for its level. */
interface Pair {
  sight: Sight;
  threat: Sight;
}

export function pairsOf(sights: Sights): Pair[] {
  return sights.all.flatMap((sight) => {
    const threat = sight.level === 0 ? undefined : sights.get(sight.threat_id);
    return threat !== undefined && (sight.in_view || threat.in_view) ? [{ sight, threat }] : [];
  });
}

/** From each threatened UAV a line to where it is when both are closest, and between these two points how far they miss. */
export function drawApproaches(
  context: CanvasRenderingContext2D,
  view: View,
  frame: LocalFrame,
  pairs: readonly Pair[],
  colours: Colours,
): void {
  const on_screen = (point: Point, sight: Sight) =>
    pixelOf(view, frame, point.east_m, point.north_m, sight.place.up_m);
  // A stroke for each level, whatever the number of pairs.
  const lines = colours.level.map(() => new Path2D());
  const misses = colours.level.map(() => new Path2D());
  for (const { sight, threat } of pairs) {
    const approach = closestApproach(moverOf(sight), moverOf(threat));
    const [line, miss] = [lines[sight.level], misses[sight.level]];
    if (line === undefined || miss === undefined) continue;
    if (approach === null) {
      // They are as close as they will be: the line says with whom.
      segment(miss, sight, threat);
      continue;
    }
    const own = on_screen(approach.own, sight);
    segment(line, sight, own);
    line.rect(own.x - kMark_px, own.y - kMark_px, 2 * kMark_px, 2 * kMark_px);
    segment(miss, own, on_screen(approach.other, threat));
  }
  for (const [level, colour] of colours.level.entries()) {
    context.strokeStyle = colour;
    context.lineWidth = 2;
    if (lines[level] !== undefined) context.stroke(lines[level]);
    context.lineWidth = 1.5;
    context.setLineDash([2, 4]);
    if (misses[level] !== undefined) context.stroke(misses[level]);
    context.setLineDash([]);
  }
}

/** Above a UAV that is higher than its threat, below one that is lower: by how much, and an arrow when it climbs or descends. */
export function drawTags(
  context: CanvasRenderingContext2D,
  pairs: readonly Pair[],
  colours: Colours,
  texts: TextImages,
): void {
  for (const { sight, threat } of pairs) {
    const higher_m = sight.place.up_m - threat.place.up_m;
    const text = `${higher_m >= 0 ? "+" : ""}${altitude.full(higher_m)}${climbArrow(sight)}`;
    const colour = colours.level[sight.level] ?? colours.text;
    const image = texts.get(`${text} ${colour}`, () => ({
      lines: [{ text, font: kTagFont, colour }],
      width: texts.width(text, kTagFont) + 2 * kTagPadding_px,
      height: kTagHeight_px,
      background: colours.tag,
      padding_px: kTagPadding_px,
      line_px: kTagHeight_px,
    }));
    const y = higher_m >= 0 ? sight.y - kFrameRadius_px - image.height : sight.y + kFrameRadius_px;
    const snap = (value: number) => Math.round(value * texts.ratio) / texts.ratio;
    context.drawImage(image.image, snap(sight.x - image.width / 2), snap(y), image.width, image.height);
  }
}

function moverOf({ place, speed_m_s, course_rad, climb_rad }: Sight): Mover {
  return { east_m: place.east_m, north_m: place.north_m, speed_m_s, course_rad, climb_rad };
}

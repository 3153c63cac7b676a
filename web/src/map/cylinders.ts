/** The cylinder that nobody else of the formation may enter: R around the UAV, H above and below it. */
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { altitude, distance } from "../units/quantities";
import type { Colours } from "./colours";
import { clearanceOf, type Sight } from "./sights";
import type { TextImages } from "./text_images";
import { pixelsPerMetre, type View } from "./view";

const kNoteFont = "550 11px 'Inter Variable', sans-serif";
const kTag_px = 18;
/** Cylinders of more UAVs than this hide the map. */
const kMost = 50;

/** Those of the selected UAVs; the last one tells its size. */
export function drawCylinders(
  context: CanvasRenderingContext2D,
  view: View,
  frame: LocalFrame,
  sights: readonly Sight[],
  store: Store,
  colours: Colours,
  texts: TextImages,
): void {
  for (const sight of sights.filter(({ selected }) => selected).slice(0, kMost)) {
    const formation = store.formations.peek().get(sight.formation_id);
    if (formation === undefined) continue;
    const radius_px = formation.radius_m * pixelsPerMetre(view, frame.origin.latitude_deg);
    context.strokeStyle = colours.text;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(sight.x, sight.y, radius_px, 0, 2 * Math.PI);
    context.stroke();
    if (sight.id !== store.selected_id.peek()) continue;
    const text = `R ${distance.full(formation.radius_m)}, H ${altitude.full(formation.height_m)}`;
    const { image, width, height } = texts.get(text, () => ({
      lines: [{ text, font: kNoteFont, colour: colours.text }],
      width: texts.width(text, kNoteFont) + 8,
      height: 18,
      background: colours.tag,
      padding_px: 3,
      line_px: 14,
    }));
    // Below the tag that a threatened UAV may have.
    const y = sight.y + Math.max(radius_px, clearanceOf(sight) + (sight.level > 0 ? kTag_px : 0)) + 3;
    context.drawImage(image, Math.round(sight.x - width / 2), Math.round(y), width, height);
  }
}

/** The texts beside symbols. Places are chosen a few times a second; in between, labels move with their symbols. */
import type { FormationStatus } from "../link/messages";
import type { Store } from "../state/store";
import { duration, fixed } from "../units/format";
import type { Colours } from "./colours";
import type { Sight } from "./fleet_layer";
import { placeLabels, type LabelRequest, type PlacedLabel } from "./labels";
import type { Pixel } from "./view";

const kFont = "'Inter Variable', sans-serif";
const kNameFont = `600 12px ${kFont}`;
const kDataFont = `500 11px ${kFont}`;
const kPadding_px = 4;
const kLine_px = 14;
const kReplace_ms = 250;
/** More labels than this are a wall of text: the most important have them. */
const kMostLabels = 120;

export class FleetLabels {
  private placed: ReadonlyMap<number, PlacedLabel> = new Map();
  private placed_ms = -Infinity;

  constructor(private readonly store: Store) {}

  draw(context: CanvasRenderingContext2D, sights: readonly Sight[], colours: Colours, now_ms: number): void {
    if (now_ms - this.placed_ms > kReplace_ms) {
      this.placed_ms = now_ms;
      const requests = this.mostImportant(sights).map((sight) => this.request(context, sight, now_ms));
      this.placed = new Map(placeLabels(requests, this.placed).map((label) => [label.id, label]));
    }
    context.textBaseline = "top";
    for (const sight of sights) {
      const label = this.placed.get(sight.id);
      if (label !== undefined) this.drawOne(context, sight, label, colours, now_ms);
    }
    context.textBaseline = "alphabetic";
  }

  drawLeader(context: CanvasRenderingContext2D, at: Pixel, status: FormationStatus, colours: Colours): void {
    const name = this.store.formations.peek().get(status.formation_id)?.name ?? "";
    context.font = kDataFont;
    context.fillStyle = colours.map_text;
    context.fillText(
      `Leader of ${name === "" ? `formation ${status.formation_id}` : name}`,
      at.x + 14,
      at.y + 4,
    );
  }

  private mostImportant(sights: readonly Sight[]): Sight[] {
    const selected = this.store.selected_id.peek();
    const weight = (sight: Sight) =>
      (sight.id === selected ? 10 : 0) + sight.level * 2 + (sight.lost ? 3 : 0);
    return [...sights].sort((a, b) => weight(b) - weight(a) || a.id - b.id).slice(0, kMostLabels);
  }

  private data(sight: Sight, now_ms: number): string {
    const motion = this.store.fleet.motion;
    if (motion === null) return "";
    if (sight.lost) return `lost ${duration(this.store.fleet.downlinkAge_s(sight.id, now_ms))}`;
    return `${fixed(sight.place.up_m)} m ENU  ${fixed(motion.speed_m_s[sight.row])} m/s`;
  }

  private request(context: CanvasRenderingContext2D, sight: Sight, now_ms: number): LabelRequest {
    context.font = kNameFont;
    const name_width = context.measureText(this.store.callsign(sight.id)).width;
    context.font = kDataFont;
    const course_rad = this.store.fleet.motion?.course_rad[sight.row] ?? 0;
    const data_width = context.measureText(this.data(sight, now_ms).replace(/\d/g, "0")).width;
    return {
      id: sight.id,
      x: sight.x,
      y: sight.y,
      heading_x: Math.cos(course_rad),
      heading_y: -Math.sin(course_rad),
      clearance: sight.clearance_px + 3,
      width: Math.max(name_width, data_width) + 2 * kPadding_px,
      height: 2 * kLine_px + 2 * kPadding_px - 2,
      compact_width: name_width + 2 * kPadding_px,
      compact_height: kLine_px + 2 * kPadding_px - 2,
    };
  }

  private drawOne(
    context: CanvasRenderingContext2D,
    sight: Sight,
    label: PlacedLabel,
    colours: Colours,
    now_ms: number,
  ): void {
    const name = this.store.callsign(sight.id);
    const data = this.data(sight, now_ms);
    const x = Math.round(sight.x + label.dx);
    const y = Math.round(sight.y + label.dy);
    context.font = kNameFont;
    let width = context.measureText(name).width;
    if (!label.compact) {
      context.font = kDataFont;
      width = Math.max(width, context.measureText(data).width);
    }
    context.fillStyle = colours.tag;
    const height = (label.compact ? 1 : 2) * kLine_px + 2 * kPadding_px - 2;
    context.beginPath();
    context.roundRect(x, y, width + 2 * kPadding_px, height, 3);
    context.fill();
    context.font = kNameFont;
    context.fillStyle = colours.text;
    context.fillText(name, x + kPadding_px, y + kPadding_px);
    if (label.compact) return;
    context.font = kDataFont;
    context.fillStyle = colours.muted;
    context.fillText(data, x + kPadding_px, y + kPadding_px + kLine_px);
  }
}

/** The texts beside symbols. Places are chosen a few times a second; in between, labels move with their symbols. */
import type { Waypoint } from "../link/messages";
import type { Store } from "../state/store";
import { duration, fixed } from "../units/format";
import type { Colours } from "./colours";
import type { Sight } from "./fleet_layer";
import { placeLabels, type LabelRequest, type PlacedLabel } from "./labels";
import { kSymbolRadius_px, kWaypointRadius_px } from "./shapes";
import type { Pixel } from "./view";

const kFont = "'Inter Variable', sans-serif";
const kNameFont = `600 12px ${kFont}`;
const kDataFont = `500 11px ${kFont}`;
const kPadding_px = 4;
const kLine_px = 14;
const kGap_px = 3;
const kReplace_ms = 250;
/** More labels than this are a wall of text: the most important have them. */
const kMostLabels = 120;

/** A waypoint of a formation's path, as it is drawn. */
export interface WaypointSight extends Pixel {
  formation_id: number;
  /** 1, 2, ... along the path. */
  number: number;
  waypoint: Waypoint;
}

/** The virtual leader of a formation, as it is drawn. */
export interface LeaderSight extends Pixel {
  formation_id: number;
  course_rad: number;
}

/** What is to be written beside a symbol. */
interface Caption extends Pixel {
  key: string;
  name: string;
  /** Second line, "": none. */
  data: string;
  course_rad: number;
  clearance_px: number;
  weight: number;
  quiet: boolean;
}

export class FleetLabels {
  private placed: ReadonlyMap<string, PlacedLabel> = new Map();
  private placed_ms = -Infinity;

  constructor(private readonly store: Store) {}

  draw(
    context: CanvasRenderingContext2D,
    sights: readonly Sight[],
    leaders: readonly LeaderSight[],
    waypoints: readonly WaypointSight[],
    colours: Colours,
    now_ms: number,
  ): void {
    const captions = [
      ...sights.map((sight) => this.captionOf(sight, now_ms)),
      ...leaders.map((leader) => this.captionOfLeader(leader)),
      ...waypoints.map(captionOfWaypoint),
    ];
    if (now_ms - this.placed_ms > kReplace_ms) {
      this.placed_ms = now_ms;
      const wanted = [...captions].sort((a, b) => b.weight - a.weight).slice(0, kMostLabels);
      const requests = wanted.map((caption) => request(context, caption));
      this.placed = new Map(placeLabels(requests, this.placed).map((label) => [label.key, label]));
    }
    context.textBaseline = "top";
    for (const caption of captions) {
      const label = this.placed.get(caption.key);
      if (label !== undefined) write(context, caption, label, colours);
    }
    context.textBaseline = "alphabetic";
  }

  private captionOf(sight: Sight, now_ms: number): Caption {
    const selected = this.store.selection.peek().has(sight.id);
    return {
      ...sight,
      key: `uav ${sight.id}`,
      quiet: false,
      name: this.store.callsign(sight.id),
      data: sight.lost
        ? `lost ${duration(this.store.fleet.downlinkAge_s(sight.id, now_ms))}`
        : `${fixed(sight.place.up_m)} m ENU  ${fixed(sight.speed_m_s)} m/s`,
      weight: (selected ? 10 : 0) + sight.level * 2 + (sight.lost ? 3 : 0),
    };
  }

  private captionOfLeader(leader: LeaderSight): Caption {
    const name = this.store.formations.peek().get(leader.formation_id)?.name ?? "";
    return {
      ...leader,
      key: `leader ${leader.formation_id}`,
      quiet: true,
      name: `Leader of ${name === "" ? `formation ${leader.formation_id}` : name}`,
      data: "",
      clearance_px: kSymbolRadius_px,
      weight: -1,
    };
  }
}

function captionOfWaypoint(sight: WaypointSight): Caption {
  return {
    ...sight,
    key: `waypoint ${sight.formation_id} ${sight.number}`,
    quiet: true,
    name: `WP${sight.number}`,
    data: `${fixed(sight.waypoint.up_m)} m ENU  ${fixed(sight.waypoint.speed_m_s)} m/s`,
    course_rad: Math.PI / 2,
    clearance_px: kWaypointRadius_px,
    weight: -2,
  };
}

function request(context: CanvasRenderingContext2D, caption: Caption): LabelRequest {
  context.font = kNameFont;
  const name_width = context.measureText(caption.name).width;
  context.font = kDataFont;
  // Room for the widest digits: the label doesn't grow and shrink with the numbers.
  const data_width = context.measureText(caption.data.replace(/\d/g, "0")).width;
  const compact_height = kLine_px + 2 * kPadding_px - 2;
  return {
    key: caption.key,
    x: caption.x,
    y: caption.y,
    heading_x: Math.cos(caption.course_rad),
    heading_y: -Math.sin(caption.course_rad),
    clearance: caption.clearance_px + kGap_px,
    width: Math.max(name_width, data_width) + 2 * kPadding_px,
    height: caption.data === "" ? compact_height : compact_height + kLine_px,
    compact_width: name_width + 2 * kPadding_px,
    compact_height,
  };
}

function write(
  context: CanvasRenderingContext2D,
  caption: Caption,
  label: PlacedLabel,
  colours: Colours,
): void {
  const x = Math.round(caption.x + label.dx);
  const y = Math.round(caption.y + label.dy);
  context.fillStyle = colours.tag;
  context.fillRect(x, y, label.width, label.height);
  context.font = kNameFont;
  context.fillStyle = caption.quiet ? colours.muted : colours.text;
  context.fillText(caption.name, x + kPadding_px, y + kPadding_px);
  if (label.compact || caption.data === "") return;
  context.font = kDataFont;
  context.fillStyle = colours.muted;
  context.fillText(caption.data, x + kPadding_px, y + kPadding_px + kLine_px);
}

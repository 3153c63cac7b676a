/** The texts beside symbols. Places are chosen a few times a second; in between, labels move with their symbols. */
import type { Waypoint } from "../link/messages";
import type { Store } from "../state/store";
import { lostText } from "../units/loss_text";
import { altitudeAbove, speed } from "../units/quantities";
import type { Colours } from "./colours";
import { placeLabels, type Box, type LabelRequest, type PlacedLabel } from "./labels";
import type { Detail } from "./looks";
import { kSymbolRadius_px, kWaypointRadius_px } from "./shapes";
import { clearanceOf, type Sight } from "./sights";
import type { TextBox, TextImage, TextImages } from "./text_images";
import type { Pixel } from "./view";

const kFont = "'Inter Variable', sans-serif";
const kNameFont = `600 12px ${kFont}`;
const kDataFont = `500 11px ${kFont}`;
const kPadding_px = 4;
const kLine_px = 14;
const kGap_px = 3;
const kReplace_ms = 250;
/** More labels than these are a wall of text: the most important have them. */
const kMostLabels: Record<Detail, number> = { full: 120, small: 60, dots: 30 };

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
interface Caption {
  key: string;
  /** Of a UAV's. */
  sight?: Sight;
  at: Pixel;
  name: string;
  /** Second line, "": none. */
  data: string;
  course_rad: number;
  clearance_px: number;
  quiet: boolean;
}

/** Somebody who may have a label. */
interface Candidate {
  weight: number;
  caption: () => Caption;
}

export interface Labelled {
  uavs: readonly Sight[];
  leaders: readonly LeaderSight[];
  waypoints: readonly WaypointSight[];
  detail: Detail;
  /** What lies over the map. */
  covers: () => readonly Box[];
}

interface Shown {
  key: string;
  sight: Sight | undefined;
  label: PlacedLabel;
  image: TextImage;
}

export class FleetLabels {
  private placed: ReadonlyMap<string, PlacedLabel> = new Map();
  private shown: readonly Shown[] = [];
  private placed_ms = -Infinity;

  constructor(
    private readonly store: Store,
    private readonly colours: Colours,
    private readonly texts: TextImages,
  ) {}

  /** They were placed for another view. */
  placeAnew(): void {
    this.placed_ms = -Infinity;
  }

  draw(context: CanvasRenderingContext2D, labelled: Labelled, now_ms: number): void {
    if (now_ms - this.placed_ms > kReplace_ms) {
      this.placed_ms = now_ms;
      this.place(labelled, now_ms);
    }
    const { ratio } = this.texts;
    // Sights move themselves; leaders and waypoints are new ones in each frame.
    const others = new Map<string, Pixel>();
    for (const leader of labelled.leaders) others.set(keyOfLeader(leader.formation_id), leader);
    for (const waypoint of labelled.waypoints) others.set(keyOfWaypoint(waypoint), waypoint);
    for (const { key, label, image, sight } of this.shown) {
      const symbol = sight ?? others.get(key);
      if (symbol === undefined || sight?.in_view === false) continue;
      const x = Math.round((symbol.x + label.dx) * ratio) / ratio;
      const y = Math.round((symbol.y + label.dy) * ratio) / ratio;
      context.drawImage(image.image, x, y, image.width, image.height);
    }
  }

  private place({ uavs, leaders, waypoints, detail, covers }: Labelled, now_ms: number): void {
    const planned_id = this.store.planned_id.peek();
    const candidates: Candidate[] = [
      ...uavs.map((sight) => ({
        // One that has a label keeps it before others of the same importance.
        weight:
          (sight.selected ? 10 : 0) +
          sight.level * 2 +
          (sight.lost ? 3 : 0) +
          (this.placed.has(keyOfUav(sight.id)) ? 0.5 : 0),
        caption: () => this.captionOf(sight, now_ms),
      })),
      ...leaders.map((leader) => ({ weight: -1, caption: () => this.captionOfLeader(leader) })),
      ...waypoints
        .filter(({ formation_id }) => formation_id !== planned_id)
        .map((waypoint) => ({ weight: -2, caption: () => captionOfWaypoint(waypoint) })),
    ];
    const captions = candidates
      .sort((a, b) => b.weight - a.weight)
      .slice(0, kMostLabels[detail])
      .map(({ caption }) => caption());
    const by_key = new Map(captions.map((caption) => [caption.key, caption]));
    const labels = placeLabels(
      captions.map((caption) => this.request(caption)),
      this.placed,
      covers(),
    );
    this.placed = new Map(labels.map((label) => [label.key, label]));
    this.shown = labels.flatMap((label) => {
      const caption = by_key.get(label.key);
      if (caption === undefined) return [];
      const { key, sight } = caption;
      return [{ key, sight, label, image: this.imageOf(caption, label) }];
    });
    this.texts.sweep();
  }

  private captionOf(sight: Sight, now_ms: number): Caption {
    return {
      key: keyOfUav(sight.id),
      sight,
      at: sight,
      quiet: false,
      name: this.store.callsign(sight.id),
      data: sight.lost
        ? lostText(this.store.fleet.downlinkAge_s(sight.id, now_ms))
        : `${altitudeAbove(sight.place.up_m)}  ${speed.full(sight.speed_m_s)}`,
      course_rad: sight.course_rad,
      clearance_px: clearanceOf(sight),
    };
  }

  private captionOfLeader(leader: LeaderSight): Caption {
    const name = this.store.formations.peek().get(leader.formation_id)?.name ?? "";
    return {
      key: keyOfLeader(leader.formation_id),
      at: leader,
      quiet: true,
      name: `Leader of ${name === "" ? `formation ${leader.formation_id}` : name}`,
      data: "",
      course_rad: leader.course_rad,
      clearance_px: kSymbolRadius_px,
    };
  }

  private request(caption: Caption): LabelRequest {
    const name_width = this.texts.width(caption.name, kNameFont);
    // Room for the widest digits: the label doesn't grow and shrink with the numbers.
    const data_width = this.texts.width(caption.data.replace(/\d/g, "0"), kDataFont);
    const compact_height = kLine_px + 2 * kPadding_px - 2;
    return {
      key: caption.key,
      x: caption.at.x,
      y: caption.at.y,
      heading_x: Math.cos(caption.course_rad),
      heading_y: -Math.sin(caption.course_rad),
      clearance: caption.clearance_px + kGap_px,
      width: Math.max(name_width, data_width) + 2 * kPadding_px,
      height: caption.data === "" ? compact_height : compact_height + kLine_px,
      compact_width: name_width + 2 * kPadding_px,
      compact_height,
    };
  }

  private imageOf(caption: Caption, label: PlacedLabel): TextImage {
    const data = label.compact ? "" : caption.data;
    const name_colour = caption.quiet ? this.colours.muted : this.colours.text;
    const box = (): TextBox => ({
      lines: [
        { text: caption.name, font: kNameFont, colour: name_colour },
        { text: data, font: kDataFont, colour: this.colours.muted },
      ],
      width: label.width,
      height: label.height,
      background: this.colours.tag,
      padding_px: kPadding_px,
      line_px: kLine_px,
    });
    return this.texts.get(`${caption.name}\n${data}\n${name_colour} ${label.width.toFixed(1)}`, box);
  }
}

const keyOfUav = (id: number) => `uav ${id}`;
const keyOfLeader = (formation_id: number) => `leader ${formation_id}`;
const keyOfWaypoint = (sight: WaypointSight) => `waypoint ${sight.formation_id} ${sight.number}`;

function captionOfWaypoint(sight: WaypointSight): Caption {
  return {
    key: keyOfWaypoint(sight),
    at: sight,
    quiet: true,
    name: `WP${sight.number}`,
    data: `${altitudeAbove(sight.waypoint.up_m)}  ${speed.full(sight.waypoint.speed_m_s)}`,
    course_rad: Math.PI / 2,
    clearance_px: kWaypointRadius_px,
  };
}

/** The UAVs, their slots and leaders: drawn in every frame of the screen, each carried on between two frames of telemetry. */
import type { Map as LeafletMap } from "leaflet";
import type { FormationStatus } from "../link/messages";
import type { Place } from "../state/fleet";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { identityOf, type Colours } from "./colours";
import { FleetLabels, type LeaderSight, type WaypointSight } from "./fleet_labels";
import { Overlay } from "./overlay";
import { at, kAircraft, kFrameRadius_px, kLeader, kLevelFrames, kSlot, kSymbolRadius_px } from "./shapes";
import type { Trails } from "./trails";
import { pixelOf, pixelsPerMetre, viewOf, type Pixel, type View } from "./view";

const kVector_s = 30;
const kPick_px = 22;
/** Waypoints say altitude and speed from this scale on. */
const kWaypointText_px_per_m = 0.03;

/** A UAV as it is drawn in this frame. */
export interface Sight extends Pixel {
  id: number;
  place: Place;
  level: number;
  lost: boolean;
  uncertainty_m: number;
  clearance_px: number;
  speed_m_s: number;
  course_rad: number;
}

export class FleetLayer {
  private readonly overlay: Overlay;
  private readonly labels: FleetLabels;
  /** As last drawn. */
  sights: readonly Sight[] = [];

  constructor(
    private readonly map: LeafletMap,
    private readonly store: Store,
    private readonly trails: Trails,
  ) {
    this.overlay = new Overlay(map, "fleet");
    this.labels = new FleetLabels(store);
  }

  remove(): void {
    this.overlay.remove();
  }

  /** The UAV under a point of the map, null: there is none. */
  pick(point: Pixel): number | null {
    let nearest: { id: number; distance: number } | null = null;
    for (const sight of this.sights) {
      const distance = Math.hypot(sight.x - point.x, sight.y - point.y);
      if (distance <= kPick_px && (nearest === null || distance < nearest.distance))
        nearest = { id: sight.id, distance };
    }
    return nearest?.id ?? null;
  }

  draw(frame: LocalFrame | null, colours: Colours, now_ms: number): void {
    const context = this.overlay.begin();
    if (frame === null) {
      this.sights = [];
      return;
    }
    const view = viewOf(this.map);
    this.sights = this.look(view, frame, now_ms);
    const by_id = new Map(this.sights.map((sight) => [sight.id, sight]));
    const statuses = [...this.store.statuses.peek().values()];
    const leaders = statuses.map((status) =>
      this.drawFormation(context, view, frame, status, by_id, colours, now_ms),
    );
    for (const sight of this.sights) this.drawVector(context, view, frame, sight, colours);
    for (const sight of this.sights) this.drawSymbol(context, view, frame, sight, colours);
    this.labels.draw(context, this.sights, leaders, this.waypoints(view, frame), colours, now_ms);
  }

  private look(view: View, frame: LocalFrame, now_ms: number): Sight[] {
    const { fleet } = this.store;
    const { motion, status } = fleet;
    if (motion === null) return [];
    const sights: Sight[] = [];
    for (let row = 0; row < motion.count; row += 1) {
      const id = motion.id[row];
      const place = fleet.placeAt(row, now_ms);
      const at_px = pixelOf(view, frame, place.east_m, place.north_m, place.up_m);
      const status_row = fleet.statusRow(id);
      const level = status !== null && status_row >= 0 ? status.level[status_row] : 0;
      sights.push({
        ...at_px,
        id,
        place,
        level,
        lost: fleet.isLost(id),
        uncertainty_m: status !== null && status_row >= 0 ? status.horizontal_uncertainty_m[status_row] : 0,
        clearance_px: level > 0 ? kFrameRadius_px : kSymbolRadius_px,
        speed_m_s: motion.speed_m_s[row],
        course_rad: motion.course_rad[row],
      });
    }
    return sights;
  }

  /** Those that say their altitude and speed: none from far away. */
  private waypoints(view: View, frame: LocalFrame): WaypointSight[] {
    if (pixelsPerMetre(view, frame.origin.latitude_deg) < kWaypointText_px_per_m) return [];
    return [...this.store.paths.peek().values()].flatMap(({ formation_id, waypoints }) =>
      waypoints.map((waypoint, i) => ({
        ...pixelOf(view, frame, waypoint.east_m, waypoint.north_m, waypoint.up_m),
        formation_id,
        number: i + 1,
        waypoint,
      })),
    );
  }

  private colourOf(id: number, colours: Colours): string {
    return colours.identity[identityOf(id) - 1] ?? colours.text;
  }

  private drawFormation(
    context: CanvasRenderingContext2D,
    view: View,
    frame: LocalFrame,
    status: FormationStatus,
    sights: ReadonlyMap<number, Sight>,
    colours: Colours,
    now_ms: number,
  ): LeaderSight {
    const ahead_s = this.store.fleet.since_s(status.utime, now_ms);
    const east_m = status.leader_speed_m_s * Math.cos(status.leader_course_rad) * ahead_s;
    const north_m = status.leader_speed_m_s * Math.sin(status.leader_course_rad) * ahead_s;

    for (const slot of status.slots) {
      const { x, y } = pixelOf(
        view,
        frame,
        slot.slot_east_m + east_m,
        slot.slot_north_m + north_m,
        slot.slot_up_m,
      );
      context.strokeStyle = this.colourOf(slot.vehicle_id, colours);
      context.lineWidth = 1.5;
      const uav = sights.get(slot.vehicle_id);
      if (uav !== undefined && Math.hypot(uav.x - x, uav.y - y) > kSymbolRadius_px) {
        context.globalAlpha = 0.6;
        context.setLineDash([3, 4]);
        line(context, uav, { x, y });
        context.setLineDash([]);
      }
      context.globalAlpha = slot.flown ? 0.9 : 0.45;
      at(context, x, y, 0, () => {
        context.stroke(kSlot);
      });
      context.globalAlpha = 1;
    }

    const leader = pixelOf(
      view,
      frame,
      status.leader_east_m + east_m,
      status.leader_north_m + north_m,
      status.leader_up_m,
    );
    context.strokeStyle = colours.text;
    context.lineWidth = 1.8;
    at(context, leader.x, leader.y, Math.PI / 2 - status.leader_course_rad, () => {
      context.stroke(kLeader);
    });
    return { ...leader, formation_id: status.formation_id, course_rad: status.leader_course_rad };
  }

  /** Where the UAV will be in half a minute, should it fly straight on. */
  private drawVector(
    context: CanvasRenderingContext2D,
    view: View,
    frame: LocalFrame,
    sight: Sight,
    colours: Colours,
  ): void {
    context.strokeStyle = this.colourOf(sight.id, colours);
    const newest = sight.lost ? null : this.trails.newest(sight.id, view);
    if (newest !== null) {
      context.globalAlpha = 0.6;
      context.lineWidth = 2;
      line(context, newest, sight);
    }
    const way_m = sight.speed_m_s * kVector_s;
    const { course_rad } = sight;
    const end = pixelOf(
      view,
      frame,
      sight.place.east_m + way_m * Math.cos(course_rad),
      sight.place.north_m + way_m * Math.sin(course_rad),
      sight.place.up_m,
    );
    context.globalAlpha = 0.85;
    context.lineWidth = 1.5;
    context.setLineDash(sight.lost ? [4, 4] : []);
    line(context, sight, end);
    context.setLineDash([]);
    at(context, end.x, end.y, Math.PI / 2 - course_rad, () => {
      line(context, { x: -4, y: 0 }, { x: 4, y: 0 });
    });
    context.globalAlpha = 1;
  }

  private drawSymbol(
    context: CanvasRenderingContext2D,
    view: View,
    frame: LocalFrame,
    sight: Sight,
    colours: Colours,
  ): void {
    const colour = this.colourOf(sight.id, colours);
    if (sight.lost && sight.uncertainty_m > 0) {
      const radius = sight.uncertainty_m * pixelsPerMetre(view, frame.origin.latitude_deg);
      context.strokeStyle = colour;
      context.lineWidth = 1.2;
      context.setLineDash([5, 4]);
      context.beginPath();
      context.arc(sight.x, sight.y, Math.max(radius, kSymbolRadius_px + 3), 0, 2 * Math.PI);
      context.stroke();
      context.setLineDash([]);
    }
    at(context, sight.x, sight.y, 0, () => {
      const outline = kLevelFrames[sight.level] ?? null;
      if (outline !== null) {
        const level_colour = colours.level[sight.level] ?? colours.text;
        context.globalAlpha = 0.16;
        context.fillStyle = level_colour;
        context.fill(outline);
        context.globalAlpha = 1;
        context.strokeStyle = level_colour;
        context.lineWidth = 2.5;
        context.stroke(outline);
      }
      if (this.store.selection.peek().has(sight.id)) brackets(context, colours.text);
    });
    at(context, sight.x, sight.y, Math.PI / 2 - sight.course_rad, () => {
      context.lineJoin = "round";
      context.strokeStyle = sight.lost ? colour : colours.map_halo;
      context.lineWidth = sight.lost ? 1.5 : 3;
      context.stroke(kAircraft);
      context.fillStyle = sight.lost ? colours.map_halo : colour;
      context.fill(kAircraft);
    });
  }
}

function line(context: CanvasRenderingContext2D, a: Pixel, b: Pixel): void {
  context.beginPath();
  context.moveTo(a.x, a.y);
  context.lineTo(b.x, b.y);
  context.stroke();
}

/** The corners around the selected UAV. */
function brackets(context: CanvasRenderingContext2D, colour: string): void {
  const far = 26;
  const arm = 7;
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  context.beginPath();
  for (const [x, y] of [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ] as const) {
    context.moveTo(x * far, y * (far - arm));
    context.lineTo(x * far, y * far);
    context.lineTo(x * (far - arm), y * far);
  }
  context.stroke();
}

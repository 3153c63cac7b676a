/** The UAVs, their slots and leaders: drawn in every frame of the screen, each carried on between two frames of telemetry. */
import type { Map as LeafletMap } from "leaflet";
import type { FormationStatus } from "../link/messages";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { identityOf, type Colours } from "./colours";
import { coversOf } from "./covers";
import { drawCylinders } from "./cylinders";
import { FleetLabels, type LeaderSight, type WaypointSight } from "./fleet_labels";
import { layers, trails_of } from "./layers";
import { detailOf, type Detail } from "./looks";
import { Overlay } from "./overlay";
import { kSymbolRadius_px } from "./shapes";
import { Sights, type Sight } from "./sights";
import { Sprites } from "./sprites";
import { identityPaths, segment, strokeAll } from "./strokes";
import { TextImages } from "./text_images";
import { drawApproaches, drawTags, pairsOf } from "./threat_layer";
import type { Trails } from "./trails";
import { pixelOf, pixelsPerMetre, type Pixel, type View } from "./view";

const kVector_s = 30;
/** Waypoints say altitude and speed from this scale on. */
const kWaypointText_px_per_m = 0.03;

/** What is remade when colours or the screen's resolution change. */
interface Looks {
  colours: Colours;
  sprites: Sprites;
  texts: TextImages;
  labels: FleetLabels;
}

/** What all that draws a frame is given. */
interface Scene extends Looks {
  context: CanvasRenderingContext2D;
  view: View;
  frame: LocalFrame;
  now_ms: number;
  detail: Detail;
}

export class FleetLayer {
  private readonly overlay: Overlay;
  private readonly sights = new Sights();
  private looks: Looks | null = null;

  constructor(
    private readonly map: LeafletMap,
    private readonly store: Store,
    private readonly trails: Trails,
  ) {
    this.overlay = new Overlay(map, "fleet");
  }

  remove(): void {
    this.overlay.remove();
  }

  align(view: View): void {
    this.overlay.align(view);
  }

  placeLabelsAnew(): void {
    this.looks?.labels.placeAnew();
  }

  /** Of those that were drawn last. */
  get fastest_m_s(): number {
    return this.sights.fastest_m_s;
  }

  /** The UAV nearest to a point of the map, null: none is within reach. */
  pick(point: Pixel, reach_px: number): number | null {
    let nearest: { id: number; distance: number } | null = null;
    for (const sight of this.sights.visible) {
      const distance = Math.hypot(sight.x - point.x, sight.y - point.y);
      if (distance <= reach_px && (nearest === null || distance < nearest.distance))
        nearest = { id: sight.id, distance };
    }
    return nearest?.id ?? null;
  }

  /** Those in a box of the map. */
  within(a: Pixel, b: Pixel): number[] {
    const inside = (value: number, from: number, to: number) =>
      value >= Math.min(from, to) && value <= Math.max(from, to);
    return this.sights.visible
      .filter((sight) => inside(sight.x, a.x, b.x) && inside(sight.y, a.y, b.y))
      .map((sight) => sight.id);
  }

  draw(view: View, frame: LocalFrame | null, colours: Colours, now_ms: number): void {
    const context = this.overlay.begin(view);
    if (frame === null) {
      this.sights.clear();
      return;
    }
    this.sights.look(this.store, view, frame, now_ms);
    const { visible } = this.sights;
    const detail = detailOf(visible.length, view.width_px, view.height_px);
    const scene = { ...this.looksFor(colours), context, view, frame, now_ms, detail };
    const leaders = this.drawFormations(scene);
    if (layers.cylinders.shown.peek())
      drawCylinders(context, view, frame, visible, this.store, colours, scene.texts);
    if (layers.vectors.shown.peek() && detail !== "dots") this.drawVectors(scene);
    const pairs = pairsOf(this.sights);
    if (layers.approaches.shown.peek() && detail !== "dots")
      drawApproaches(context, view, frame, pairs, colours);
    this.drawGhosts(scene);
    this.drawSymbols(scene);
    if (detail === "full") drawTags(context, pairs, colours, scene.texts);
    if (layers.labels.shown.peek()) {
      const waypoints = this.waypoints(view, frame);
      const covers = () => coversOf(this.map.getContainer());
      scene.labels.draw(context, { uavs: visible, leaders, waypoints, detail, covers }, now_ms);
    } else scene.texts.sweep();
  }

  private looksFor(colours: Colours): Looks {
    const ratio = window.devicePixelRatio;
    if (this.looks?.colours !== colours || this.looks.sprites.ratio !== ratio) {
      const texts = new TextImages(ratio);
      const labels = new FleetLabels(this.store, colours, texts);
      this.looks = { colours, texts, labels, sprites: new Sprites(colours, ratio) };
    }
    return this.looks;
  }

  /** Those that say their altitude and speed: none from far away. */
  private waypoints(view: View, frame: LocalFrame): WaypointSight[] {
    if (!layers.paths.shown.peek()) return [];
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

  private drawFormations(scene: Scene): LeaderSight[] {
    const { context, sprites, detail } = scene;
    const errors = identityPaths();
    const leaders: LeaderSight[] = [];
    const slots: (() => void)[] = [];
    for (const status of this.store.statuses.peek().values()) {
      const leader = this.lookAtFormation(scene, status, errors, slots);
      leaders.push(leader);
      sprites.put(context, sprites.leader(Math.PI / 2 - leader.course_rad, detail), leader.x, leader.y);
    }
    context.globalAlpha = 0.6;
    context.setLineDash([3, 4]);
    strokeAll(context, errors, scene.colours, 1.5);
    context.setLineDash([]);
    context.globalAlpha = 1;
    for (const draw of slots) draw();
    return leaders;
  }

  private lookAtFormation(
    { context, view, frame, now_ms, sprites, detail }: Scene,
    status: FormationStatus,
    errors: readonly Path2D[],
    slots: (() => void)[],
  ): LeaderSight {
    const ahead_m = status.leader_speed_m_s * this.store.fleet.since_s(status.utime, now_ms);
    const east_m = Math.cos(status.leader_course_rad) * ahead_m;
    const north_m = Math.sin(status.leader_course_rad) * ahead_m;
    const reach_px = detail === "full" ? kSymbolRadius_px : kSymbolRadius_px / 2;
    if (layers.slots.shown.peek() && detail !== "dots") {
      for (const slot of status.slots) {
        const uav = this.sights.get(slot.vehicle_id);
        if (uav?.in_view === false) continue;
        const at = pixelOf(
          view,
          frame,
          slot.slot_east_m + east_m,
          slot.slot_north_m + north_m,
          slot.slot_up_m,
        );
        const identity = identityOf(slot.vehicle_id);
        const away = uav !== undefined && Math.hypot(uav.x - at.x, uav.y - at.y) > reach_px;
        if (away) segment(errors[identity - 1], uav, at);
        // Where symbols are small, one that fills its slot hides it.
        if (detail === "full" || away)
          slots.push(() => {
            sprites.put(context, sprites.slot(identity, slot.flown, detail), at.x, at.y);
          });
      }
    }
    return {
      ...pixelOf(
        view,
        frame,
        status.leader_east_m + east_m,
        status.leader_north_m + north_m,
        status.leader_up_m,
      ),
      formation_id: status.formation_id,
      course_rad: status.leader_course_rad,
    };
  }

  /** Where each will be in half a minute, should it fly straight on, and the last piece of its trail. */
  private drawVectors({ context, view, frame, colours, detail }: Scene): void {
    const [links, vectors, ghosts] = [identityPaths(), identityPaths(), identityPaths()];
    for (const sight of this.sights.visible) {
      const newest = sight.lost || !hasTrail(sight) ? null : this.trails.newest(sight.id, view);
      if (newest !== null) segment(links[sight.identity - 1], newest, sight);
      const way_m = sight.speed_m_s * Math.cos(sight.climb_rad) * kVector_s;
      const [across, along] = [Math.cos(sight.course_rad), Math.sin(sight.course_rad)];
      const { east_m, north_m, up_m } = sight.place;
      const end = pixelOf(view, frame, east_m + way_m * across, north_m + way_m * along, up_m);
      const path = (sight.lost ? ghosts : vectors)[sight.identity - 1];
      segment(path, sight, end);
      if (detail === "full")
        segment(
          path,
          { x: end.x - 4 * along, y: end.y - 4 * across },
          { x: end.x + 4 * along, y: end.y + 4 * across },
        );
    }
    context.globalAlpha = 0.6;
    strokeAll(context, links, colours, 2);
    context.globalAlpha = 0.85;
    strokeAll(context, vectors, colours, 1.5);
    context.setLineDash([4, 4]);
    strokeAll(context, ghosts, colours, 1.5);
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  /** Where those who are lost may be: a circle that grows until they are heard again. */
  private drawGhosts({ context, view, frame, colours }: Scene): void {
    const per_metre = pixelsPerMetre(view, frame.origin.latitude_deg);
    const circles = identityPaths();
    for (const sight of this.sights.visible) {
      if (!sight.lost || sight.uncertainty_m <= 0) continue;
      const radius_px = Math.max(sight.uncertainty_m * per_metre, kSymbolRadius_px + 3);
      const circle = circles[sight.identity - 1];
      circle?.moveTo(sight.x + radius_px, sight.y);
      circle?.arc(sight.x, sight.y, radius_px, 0, 2 * Math.PI);
    }
    context.setLineDash([5, 4]);
    strokeAll(context, circles, colours, 1.2);
    context.setLineDash([]);
  }

  private drawSymbols({ context, sprites, detail }: Scene): void {
    const { visible } = this.sights;
    // The most serious last, over all others.
    for (let level = 0; level <= 3; level += 1) {
      for (const sight of visible) {
        if (sight.level !== level) continue;
        const frame = sprites.level(level, detail);
        if (frame !== null) sprites.put(context, frame, sight.x, sight.y);
        const symbol = sight.stranger
          ? sprites.traffic(sight.identity, sight.lost, detail)
          : sprites.aircraft(sight.identity, sight.lost, Math.PI / 2 - sight.course_rad, detail);
        sprites.put(context, symbol, sight.x, sight.y);
        if (sight.selected) sprites.put(context, sprites.brackets(), sight.x, sight.y);
      }
    }
  }
}

/** Whether this UAV's trail is to be drawn. */
export function hasTrail(sight: Pick<Sight, "selected">): boolean {
  const of = trails_of.peek();
  return of === "all" || (of === "selected" && sight.selected);
}

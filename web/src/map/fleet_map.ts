/** The map with all its layers: one Leaflet map, two canvases, one frame clock. */
import L from "leaflet";
import { effect, signal } from "@preact/signals";
import type { Store } from "../state/store";
import { theme } from "../state/settings";
import { localFrame, type LocalFrame } from "../units/geodesy";
import { Land, tileLayer } from "./base_map";
import { Camera } from "./camera";
import { readColours, type Colours } from "./colours";
import { FleetLayer } from "./fleet_layer";
import { localGridStep_m } from "./grid";
import { GroundLayer } from "./ground_layer";
import { Trails } from "./trails";
import { pixelsPerMetre, viewOf } from "./view";

const kGroundInterval_ms = 500;
/** A fleet on a map that stands still moves by a pixel or so in this time. */
const kFleetInterval_ms = 30;
/** Where drawing is slow (no GPU, a busy machine), it leaves this part of the time to everything else, within reason. */
const kIdlePart = 0.5;
const kLongestFleetInterval_ms = 200;
const kWaitForSlots_ms = 1500;

/** What the scale shows. */
export interface MapScale {
  metres_per_pixel: number;
  /** Spacing of the local grid [m], null: meridians and parallels. */
  grid_m: number | null;
}

export class FleetMap {
  readonly following = signal(false);
  readonly scale = signal<MapScale | null>(null);
  private readonly map: L.Map;
  private readonly trails = new Trails();
  private readonly land: Land;
  private readonly ground: GroundLayer;
  private readonly fleet: FleetLayer;
  private readonly camera: Camera;
  private readonly undo: (() => void)[] = [];
  private colours: Colours = readColours();
  private frame: LocalFrame | null = null;
  private start_utime = 0;
  private ground_drawn_ms = -Infinity;
  private fleet_drawn_ms = -Infinity;
  private draw_cost_ms = 0;
  private drew = false;
  private ground_old = true;
  /** The map is to be fitted; done when the fleet and its slots are known, or the fleet alone for a while. */
  private to_fit = true;
  private fleet_seen_ms = Infinity;
  private animation = 0;

  constructor(
    container: HTMLElement,
    private readonly store: Store,
    freeArea: () => DOMRect,
  ) {
    this.map = L.map(container, {
      center: [25, 20],
      zoom: 2.5,
      minZoom: 2,
      maxZoom: 19,
      zoomSnap: 0.25,
      zoomDelta: 0.5,
      wheelPxPerZoomLevel: 120,
      // The canvases are drawn for one zoom at a time.
      zoomAnimation: false,
      zoomControl: false,
      preferCanvas: true,
    });
    this.map.attributionControl.setPrefix('<a href="https://leafletjs.com">Leaflet</a>');
    this.land = new Land(this.map);
    this.ground = new GroundLayer(this.map, store, this.trails);
    this.fleet = new FleetLayer(this.map, store, this.trails);
    this.camera = new Camera(this.map, store, freeArea);
    this.listen(container);
    // A map without land is still a map: grid, fleet and tiles don't need it.
    this.land.load().catch(() => undefined);
    this.animate(performance.now());
  }

  remove(): void {
    cancelAnimationFrame(this.animation);
    for (const step of this.undo) step();
    this.ground.remove();
    this.fleet.remove();
    this.map.remove();
  }

  /** Names those who made the map; the page places it where no panel covers it. */
  get attribution(): HTMLElement {
    return this.map.attributionControl.getContainer() ?? document.createElement("div");
  }

  fit(): void {
    this.to_fit = true;
  }

  zoom(steps: number): void {
    this.map.setZoom(this.map.getZoom() + steps);
  }

  private listen(container: HTMLElement): void {
    this.map.on("move zoom resize", () => {
      this.ground_old = true;
    });
    this.map.on("dragstart", () => {
      this.following.value = false;
    });
    this.map.on("click", (event) => {
      this.store.selected_id.value = this.fleet.pick(event.containerPoint);
    });
    const resized = new ResizeObserver(() => this.map.invalidateSize({ animate: false }));
    resized.observe(container);
    this.undo.push(
      () => {
        resized.disconnect();
      },
      effect(() => {
        this.takeRoster();
      }),
      theme.subscribe(() => {
        this.colours = readColours();
        this.land.paint(this.colours);
        this.ground_old = true;
      }),
      effect(() => {
        const tiles = tileLayer(this.store.hello.value);
        tiles?.addTo(this.map);
        return () => tiles?.remove();
      }),
    );
  }

  private takeRoster(): void {
    const roster = this.store.roster.value;
    if (roster === null) return;
    const { origin } = roster;
    const same =
      this.frame?.origin.latitude_deg === origin.latitude_deg &&
      this.frame.origin.longitude_deg === origin.longitude_deg &&
      this.frame.origin.altitude_m === origin.altitude_m;
    if (same && this.start_utime === roster.start_utime) return;
    this.frame = localFrame(origin);
    this.start_utime = roster.start_utime;
    this.trails.clear();
    this.fleet_seen_ms = Infinity;
    this.to_fit = true;
  }

  private readonly animate = (now_ms: number): void => {
    this.animation = requestAnimationFrame(this.animate);
    if (this.frame !== null) {
      this.trails.sample(this.store.fleet, this.frame);
      if (this.to_fit) this.fitNow(this.frame, now_ms);
      else if (this.following.peek()) this.camera.follow(this.frame, now_ms);
    }
    // What a drawn frame costs shows in when the next one comes.
    if (this.drew) this.draw_cost_ms = now_ms - this.fleet_drawn_ms;
    const fair_ms = this.draw_cost_ms / (1 - kIdlePart);
    const interval_ms = Math.min(Math.max(kFleetInterval_ms, fair_ms), kLongestFleetInterval_ms);
    this.drew = this.ground_old || now_ms - this.fleet_drawn_ms >= interval_ms;
    if (this.ground_old || now_ms - this.ground_drawn_ms > kGroundInterval_ms) {
      this.ground_old = false;
      this.ground_drawn_ms = now_ms;
      this.ground.draw(this.frame, this.colours);
      this.measure();
    }
    if (this.drew) {
      this.fleet_drawn_ms = now_ms;
      this.fleet.draw(this.frame, this.colours, now_ms);
    }
  };

  private fitNow(frame: LocalFrame, now_ms: number): void {
    if (!this.camera.fit(frame, now_ms)) return;
    this.fleet_seen_ms = Math.min(this.fleet_seen_ms, now_ms);
    this.to_fit = this.store.statuses.peek().size === 0 && now_ms - this.fleet_seen_ms < kWaitForSlots_ms;
  }

  private measure(): void {
    const view = viewOf(this.map);
    const latitude_deg = this.map.getCenter().lat;
    const metres_per_pixel = 1 / pixelsPerMetre(view, latitude_deg);
    const grid_m = localGridStep_m(view, this.frame);
    const known = this.scale.peek();
    if (known?.metres_per_pixel !== metres_per_pixel || known.grid_m !== grid_m) {
      this.scale.value = { metres_per_pixel, grid_m };
    }
  }
}

/** The map with all its layers: one Leaflet map, two canvases, one frame clock. */
import L from "leaflet";
import { effect, signal } from "@preact/signals";
import type { Store } from "../state/store";
import { theme } from "../state/settings";
import { localFrame, type LocalFrame } from "../units/geodesy";
import { Land } from "./base_map";
import { BoxSelect } from "./box_select";
import { Camera } from "./camera";
import { readColours, type Colours } from "./colours";
import { FleetLayer } from "./fleet_layer";
import { localGridStep_m } from "./grid";
import { base_map, layers, trail_min, trails_of } from "./layers";
import { GroundLayer } from "./ground_layer";
import type { EnuPoint, MapAccess, MapTool } from "./map_access";
import { leafletMap } from "./leaflet_map";
import { MeasureTool } from "./measure_tool";
import { showBase } from "./base_layer";
import { Trails } from "./trails";
import { neighbourOf } from "./neighbour";
import { pixelsPerMetre, viewOf, type View } from "./view";

const kGroundInterval_ms = 500;
/** A map that moves takes what was drawn along, so that it need not be drawn in every frame. */
const kMovedInterval_ms = 80;
const kLongestMovedInterval_ms = 400;
/** A fleet on a map that stands still moves by a pixel or so in this time. */
const kFleetInterval_ms = 30;
/** Where drawing is slow (no GPU, a busy machine), it leaves this part of the time to everything else, within reason. */
const kIdlePart = 0.5;
const kLongestFleetInterval_ms = 200;
const kWaitForSlots_ms = 1500;
/** A UAV is hit when its middle is this near; the nearest counts. */
const kMouse_px = 22;
const kFinger_px = 36;

/** What the scale shows. */
export interface MapScale {
  metres_per_pixel: number;
  /** Spacing of the local grid [m], null: meridians and parallels. */
  grid_m: number | null;
}

export class FleetMap implements MapAccess {
  readonly following = signal(false);
  readonly scale = signal<MapScale | null>(null);
  /** What is wrong with the base map that was chosen, for people; "": nothing. */
  readonly base_problem = signal("");
  readonly leaflet: L.Map;
  readonly measure: MeasureTool;
  readonly box: BoxSelect;
  private readonly trails = new Trails();
  private readonly land: Land;
  private readonly ground: GroundLayer;
  private readonly fleet: FleetLayer;
  private readonly camera: Camera;
  private readonly undo: (() => void)[] = [];
  private colours: Colours = readColours();
  private local: LocalFrame | null = null;
  private tool: MapTool | null = null;
  private start_utime = 0;
  private ground_drawn_ms = -Infinity;
  private fleet_drawn_ms = -Infinity;
  private ground_cost_ms = 0;
  private fleet_cost_ms = 0;
  /** What the last frame has drawn. */
  private drew: "ground" | "fleet" | null = null;
  private ground_old = true;
  /** The map is to be fitted; done when the fleet and its slots are known, or the fleet alone for a while. */
  private to_fit = true;
  private fleet_seen_ms = Infinity;
  private animation = 0;

  constructor(
    container: HTMLElement,
    private readonly store: Store,
    readonly freeArea: () => DOMRect,
  ) {
    this.leaflet = leafletMap(container);
    this.land = new Land(this.leaflet);
    this.ground = new GroundLayer(this.leaflet, store, this.trails);
    this.fleet = new FleetLayer(this.leaflet, store, this.trails);
    this.camera = new Camera(this.leaflet, store, freeArea);
    this.measure = new MeasureTool(this, () => this.middle());
    this.box = new BoxSelect(
      this,
      () => this.tool !== null,
      (a, b) => {
        store.select([...store.selection.peek(), ...this.fleet.within(a, b)]);
      },
    );
    this.listen(container);
    // A map without land is still a map: grid, fleet and tiles don't need it.
    this.land.load().catch(() => undefined);
    this.animate(performance.now());
  }

  remove(): void {
    cancelAnimationFrame(this.animation);
    for (const step of this.undo) step();
    this.measure.remove();
    this.box.remove();
    this.ground.remove();
    this.fleet.remove();
    this.leaflet.remove();
  }

  /** Names those who made the map; the page places it where no panel covers it. */
  get attribution(): HTMLElement {
    return this.leaflet.attributionControl.getContainer() ?? document.createElement("div");
  }

  fit(): void {
    this.to_fit = true;
  }

  centre(place: L.LatLng): void {
    this.following.value = false;
    this.camera.centre(place);
  }

  frame(): LocalFrame | null {
    return this.local;
  }

  place(east_m: number, north_m: number, up_m = 0): L.LatLng | null {
    if (this.local === null) return null;
    const at = this.local.toLatLon(east_m, north_m, up_m);
    return L.latLng(at.latitude_deg, at.longitude_deg);
  }

  enu(at: L.LatLng): EnuPoint | null {
    return this.local?.toEnu(at.lat, at.lng, this.local.origin.altitude_m) ?? null;
  }

  /** The middle of what is seen of the map. */
  middle(): L.LatLng {
    return this.camera.middle();
  }

  pan(x_px: number, y_px: number): void {
    this.following.value = false;
    this.leaflet.panBy([x_px, y_px], { animate: false });
  }

  /** Selects the next UAV of the roster, or the one before it, and brings it into sight. */
  selectNext(step: 1 | -1): void {
    const ids = this.store.roster.peek()?.vehicles.map((vehicle) => vehicle.id) ?? [];
    const id = neighbourOf(ids, this.store.selected_id.peek(), step);
    if (id === null) return;
    this.store.select([id]);
    if (this.local !== null) this.camera.show(this.local, id, performance.now());
  }

  /** Ends the tool that has the map; without one, nothing is selected any more. */
  leave(): void {
    if (this.tool === null) this.store.select([]);
    else this.dropTool();
  }

  private dropTool(): void {
    const tool = this.tool;
    this.tool = null;
    this.leaflet.getContainer().style.cursor = "";
    tool?.onLost();
  }

  claim(tool: MapTool): () => void {
    this.dropTool();
    this.tool = tool;
    this.leaflet.getContainer().style.cursor = tool.cursor;
    return () => {
      if (this.tool !== tool) return;
      this.tool = null;
      this.leaflet.getContainer().style.cursor = "";
    };
  }

  zoom(steps: number): void {
    this.leaflet.setZoom(this.leaflet.getZoom() + steps);
  }

  private listen(container: HTMLElement): void {
    this.leaflet.on("move zoom resize", () => {
      this.ground_old = true;
    });
    this.leaflet.on("dragstart", () => {
      this.following.value = false;
    });
    this.leaflet.on("click", (event) => {
      if (this.tool !== null) return;
      const touched = (event.originalEvent as Partial<PointerEvent>).pointerType === "touch";
      const id = this.fleet.pick(event.containerPoint, touched ? kFinger_px : kMouse_px);
      const { ctrlKey, metaKey, shiftKey } = event.originalEvent;
      if (id !== null && (ctrlKey || metaKey || shiftKey)) this.store.toggleSelected(id);
      else this.store.select(id === null ? [] : [id]);
    });
    const resized = new ResizeObserver(() => this.leaflet.invalidateSize({ animate: false }));
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
      effect(() => showBase(this.leaflet, this.store.hello.value, base_map.value, this.base_problem)),
      effect(() => {
        // Whatever of these changes, the ground is to be drawn again.
        for (const { shown } of Object.values(layers)) void shown.value;
        void [trails_of.value, trail_min.value, this.store.selection.value];
        this.ground_old = true;
      }),
    );
  }

  private takeRoster(): void {
    const roster = this.store.roster.value;
    if (roster === null) return;
    const { origin } = roster;
    const same =
      this.local?.origin.latitude_deg === origin.latitude_deg &&
      this.local.origin.longitude_deg === origin.longitude_deg &&
      this.local.origin.altitude_m === origin.altitude_m;
    if (same && this.start_utime === roster.start_utime) return;
    this.local = localFrame(origin);
    this.start_utime = roster.start_utime;
    this.trails.clear();
    this.fleet_seen_ms = Infinity;
    this.to_fit = true;
  }

  private readonly animate = (now_ms: number): void => {
    this.animation = requestAnimationFrame(this.animate);
    if (this.local !== null) {
      this.trails.sample(this.store.fleet, this.local);
      if (this.to_fit) this.fitNow(this.local, now_ms);
      else if (this.following.peek()) this.camera.follow(this.local, now_ms);
    }
    const view = viewOf(this.leaflet);
    // What a drawn frame costs shows in when the next one comes.
    if (this.drew === "fleet") this.fleet_cost_ms = now_ms - this.fleet_drawn_ms;
    if (this.drew === "ground") this.ground_cost_ms = now_ms - this.ground_drawn_ms;
    this.drew = null;
    if (this.groundIsDue(now_ms)) {
      this.ground_old = false;
      this.ground_drawn_ms = now_ms;
      this.drew = "ground";
      this.ground.draw(view, this.local, this.colours);
      this.measureScale(view);
    } else {
      this.ground.align(view);
    }
    // One of both in a frame, so that neither makes a frame long.
    if (this.drew === null && now_ms - this.fleet_drawn_ms >= this.fleetInterval_ms()) {
      this.fleet_drawn_ms = now_ms;
      this.drew = "fleet";
      this.fleet.draw(view, this.local, this.colours, now_ms);
    } else {
      this.fleet.align(view);
    }
  };

  private groundIsDue(now_ms: number): boolean {
    const fair_ms = Math.max(kMovedInterval_ms, 4 * this.ground_cost_ms);
    const interval_ms = this.ground_old ? Math.min(fair_ms, kLongestMovedInterval_ms) : kGroundInterval_ms;
    return now_ms - this.ground_drawn_ms >= interval_ms;
  }

  private fleetInterval_ms(): number {
    const fair_ms = this.fleet_cost_ms / (1 - kIdlePart);
    return Math.min(Math.max(kFleetInterval_ms, fair_ms), kLongestFleetInterval_ms);
  }

  private fitNow(frame: LocalFrame, now_ms: number): void {
    if (!this.camera.fit(frame, now_ms)) return;
    this.fleet_seen_ms = Math.min(this.fleet_seen_ms, now_ms);
    this.to_fit = this.store.statuses.peek().size === 0 && now_ms - this.fleet_seen_ms < kWaitForSlots_ms;
  }

  private measureScale(view: View): void {
    const latitude_deg = this.leaflet.getCenter().lat;
    const metres_per_pixel = 1 / pixelsPerMetre(view, latitude_deg);
    const grid_m = localGridStep_m(view, this.local);
    const known = this.scale.peek();
    if (known?.metres_per_pixel !== metres_per_pixel || known.grid_m !== grid_m) {
      this.scale.value = { metres_per_pixel, grid_m };
    }
  }
}

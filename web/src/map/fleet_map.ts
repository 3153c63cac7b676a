/** The map with all its layers: one Leaflet map, canvases over and under it, one frame clock. */
import L from "leaflet";
import { effect, signal } from "@preact/signals";
import type { Store } from "../state/store";
import { altitude_unit, distance_unit, speed_unit, theme } from "../state/settings";
import { localFrame, type LocalFrame } from "../units/geodesy";
import { BoxSelect } from "./box_select";
import { Camera } from "./camera";
import { readColours, type Colours } from "./colours";
import { localGridStep_m } from "./grid";
import { base_map, layers, trail_min, trails_of } from "./layers";
import type { EnuPoint, MapAccess, MapTool } from "./map_access";
import { leafletMap } from "./leaflet_map";
import { MeasureTool } from "./measure_tool";
import { keepBase } from "./base_layer";
import { Painter } from "./painter";
import { Trails } from "./trails";
import { neighbourOf } from "./neighbour";
import { pixelsPerMetre, type View } from "./view";

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
  private readonly painter: Painter;
  private readonly camera: Camera;
  private readonly undo: (() => void)[] = [];
  private colours: Colours = readColours();
  private local: LocalFrame | null = null;
  private tool: MapTool | null = null;
  private start_utime = 0;
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
    this.painter = new Painter(this.leaflet, store, this.trails, (view) => {
      this.measureScale(view);
    });
    this.camera = new Camera(this.leaflet, store, freeArea);
    this.measure = new MeasureTool(this, () => this.middle());
    this.box = new BoxSelect(
      this,
      () => this.tool !== null,
      (a, b) => {
        store.select([...store.selection.peek(), ...this.painter.fleet.within(a, b)]);
      },
    );
    this.listen(container);
    this.animate(performance.now());
  }

  remove(): void {
    cancelAnimationFrame(this.animation);
    for (const step of this.undo) step();
    this.measure.remove();
    this.box.remove();
    this.painter.remove();
    this.leaflet.remove();
  }

  /** Names those who made the map; the page places it where no panel covers it. */
  get attribution(): HTMLElement {
    return this.leaflet.attributionControl.getContainer() ?? document.createElement("div");
  }

  fit(): void {
    this.to_fit = true;
    // Not only with the next frame: whatever is done next is meant for the fitted map.
    if (this.local !== null) this.fitNow(this.local, performance.now());
    this.painter.demand();
  }

  centre(place: L.LatLng): void {
    this.stayHere();
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
    this.stayHere();
    this.leaflet.panBy([x_px, y_px], { animate: false });
  }

  /** A person has chosen what to look at. */
  private stayHere(): void {
    this.following.value = false;
    this.to_fit = false;
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

  keepsLongPress(at: L.Point): boolean {
    return this.tool !== null || this.painter.fleet.pick(at, kFinger_px) !== null;
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
    this.to_fit = false;
    this.leaflet.setZoom(this.leaflet.getZoom() + steps);
  }

  private listen(container: HTMLElement): void {
    this.leaflet.on("dragstart", () => {
      this.stayHere();
    });
    this.leaflet.on("click", (event) => {
      if (this.tool !== null) return;
      const touched = (event.originalEvent as Partial<PointerEvent>).pointerType === "touch";
      const id = this.painter.fleet.pick(event.containerPoint, touched ? kFinger_px : kMouse_px);
      const { ctrlKey, metaKey, shiftKey } = event.originalEvent;
      if (id !== null && (ctrlKey || metaKey || shiftKey)) this.store.toggleSelected(id);
      else this.store.select(id === null ? [] : [id]);
    });
    // A long press, where there is no Ctrl key; or the other button of the mouse.
    this.leaflet.on("contextmenu", (event) => {
      if (this.tool !== null) return;
      event.originalEvent.preventDefault();
      const id = this.painter.fleet.pick(event.containerPoint, kFinger_px);
      if (id !== null) this.store.toggleSelected(id);
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
        this.painter.demand();
      }),
      keepBase(this.leaflet, this.store.hello, base_map, theme, this.base_problem),
      effect(() => {
        // Whatever of these changes, all is to be drawn again.
        for (const { shown } of Object.values(layers)) void shown.value;
        void [trails_of.value, trail_min.value, this.store.selection.value];
        void [altitude_unit.value, distance_unit.value, speed_unit.value];
        this.painter.redraw();
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
    this.painter.paint(this.local, this.colours, now_ms);
  };

  private fitNow(frame: LocalFrame, now_ms: number): void {
    if (!this.camera.fit(frame, now_ms)) return;
    this.fleet_seen_ms = Math.min(this.fleet_seen_ms, now_ms);
    this.to_fit = this.store.statuses.peek().size === 0 && now_ms - this.fleet_seen_ms < kWaitForSlots_ms;
  }

  private measureScale(view: View): void {
    const metres_per_pixel = 1 / pixelsPerMetre(view, this.leaflet.getCenter().lat);
    const grid_m = localGridStep_m(view, this.local);
    const known = this.scale.peek();
    if (known?.metres_per_pixel !== metres_per_pixel || known.grid_m !== grid_m) {
      this.scale.value = { metres_per_pixel, grid_m };
    }
  }
}

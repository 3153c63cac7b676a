/** The canvases of the map, and when each of them is drawn. */
import type { Map as LeafletMap } from "leaflet";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { Land } from "./base_map";
import type { Colours } from "./colours";
import { FleetLayer } from "./fleet_layer";
import { GroundLayer } from "./ground_layer";
import { fleetInterval_ms, groundInterval_ms, LayerClock } from "./layer_clock";
import type { Trails } from "./trails";
import { pixelsPerMetre, viewOf, type View } from "./view";

/** Without a reason the land is drawn again as seldom as this: should the browser have lost the canvas, or the screen be another one. */
const kLandInterval_ms = 3000;

export class Painter {
  readonly fleet: FleetLayer;
  private readonly land: Land;
  private readonly ground: GroundLayer;
  private readonly land_clock = new LayerClock();
  private readonly ground_clock = new LayerClock();
  private readonly fleet_clock = new LayerClock();

  /** @param onGround is called when the ground was drawn: what depends on the view alone is worked out as often. */
  constructor(
    private readonly map: LeafletMap,
    store: Store,
    trails: Trails,
    private readonly onGround: (view: View) => void,
  ) {
    this.land = new Land(map);
    this.ground = new GroundLayer(map, store, trails);
    this.fleet = new FleetLayer(map, store, trails);
    map.on("move zoom resize", () => {
      this.land_clock.old = true;
      this.redraw();
    });
    // A map without land is still a map: grid, fleet and tiles don't need it.
    this.land.load().then(
      () => {
        this.land_clock.demand();
      },
      () => undefined,
    );
  }

  remove(): void {
    this.land.remove();
    this.ground.remove();
    this.fleet.remove();
  }

  /** What is over the land has changed: it is drawn again when it is due. */
  redraw(): void {
    this.ground_clock.old = this.fleet_clock.old = true;
  }

  /** Everything is drawn again with the next frames. */
  demand(): void {
    for (const clock of [this.land_clock, this.ground_clock, this.fleet_clock]) clock.demand();
    this.fleet.placeLabelsAnew();
  }

  /** In each frame of the screen: draws one canvas at most, so that none makes a frame long, and moves the others along. */
  paint(frame: LocalFrame | null, colours: Colours, now_ms: number): void {
    const view = viewOf(this.map);
    const { land_clock, ground_clock, fleet_clock } = this;
    for (const clock of [land_clock, ground_clock, fleet_clock]) clock.tick(now_ms);
    const land_due = land_clock.isDue(
      now_ms,
      land_clock.old ? groundInterval_ms(land_clock) : kLandInterval_ms,
    );
    const ground_due = !land_due && ground_clock.isDue(now_ms, groundInterval_ms(ground_clock));
    const speed_px_s = this.fleet.fastest_m_s * pixelsPerMetre(view, frame?.origin.latitude_deg ?? 0);
    const fleet_due =
      !land_due && !ground_due && fleet_clock.isDue(now_ms, fleetInterval_ms(fleet_clock, speed_px_s));
    if (land_due) {
      land_clock.drawn(now_ms);
      this.land.draw(view, colours);
    } else {
      this.land.align(view);
    }
    if (ground_due) {
      ground_clock.drawn(now_ms);
      this.ground.draw(view, frame, colours);
      this.onGround(view);
    } else {
      this.ground.align(view);
    }
    if (fleet_due) {
      fleet_clock.drawn(now_ms);
      this.fleet.draw(view, frame, colours, now_ms);
    } else {
      this.fleet.align(view);
    }
  }
}
